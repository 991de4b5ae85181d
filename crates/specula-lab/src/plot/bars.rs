//! Bars side by side, and points with intervals.

use super::canvas::{Anchor, Canvas, INK, width};
use super::style::{fill, marker, stroke};
use super::ticks::Scale;
use super::{Bars, Frame, Intervals, TICK_SIZE};
use crate::typeset::spans;

/// Share of a group's width that its bars take.
const FILLED: f64 = 0.8;
/// Height of a line of a group's name.
pub(super) const LINE: f64 = 13.0;

/// Draws all groups; `y` starts at what bars stand on.
pub(super) fn draw(canvas: &mut Canvas, frame: &Frame, y: &Scale, bars: &Bars) {
    let group = frame.size[0] / bars.groups.len().max(1) as f64;
    let own = group * FILLED / bars.bars.len().max(1) as f64;
    for (i, name) in bars.groups.iter().enumerate() {
        let left = frame.at[0] + group * (i as f64 + 0.5 * (1.0 - FILLED));
        for (j, (_, style, heights)) in bars.bars.iter().enumerate() {
            let value = heights.get(i).copied().filter(|h| h.is_finite());
            let [_, top] = frame.point([0.0, y.place(value.unwrap_or(y.range[0]))]);
            let top = top.clamp(frame.at[1], frame.bottom());
            let at = [left + own * j as f64, top];
            canvas.rectangle(at, [own, frame.bottom() - top], &fill(*style));
        }
        let middle = frame.at[0] + group * (i as f64 + 0.5);
        for (line, words) in wrapped(name, group - 4.0).iter().enumerate() {
            let at = [middle, frame.bottom() + 15.0 + LINE * line as f64];
            canvas.text(words, at, TICK_SIZE, Anchor::Middle);
        }
    }
}

/// Lines that names of groups need, each as wide as its group.
pub(super) fn lines(bars: &Bars, frame_width: f64) -> usize {
    let group = frame_width / bars.groups.len().max(1) as f64;
    let needed = bars.groups.iter().map(|g| wrapped(g, group - 4.0).len());
    needed.max().unwrap_or(1)
}

/// A text in lines of at most a width, but for single words that are wider.
fn wrapped(text: &str, most: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if width(&spans(&format!("{line} {word}")), TICK_SIZE) <= most => {
                line.push(' ');
                *line += word;
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// Draws points with their intervals, one below the other.
pub(super) fn intervals(canvas: &mut Canvas, frame: &Frame, x: &Scale, all: &Intervals) {
    let [mark, _] = frame.point([x.place(all.mark), 0.0]);
    let dashed = format!("stroke=\"{INK}\" stroke-dasharray=\"4 3\"");
    canvas.line([mark, frame.at[1]], [mark, frame.bottom()], &dashed);
    for (i, (_, style, [middle, low, high])) in all.rows.iter().enumerate() {
        let height = 1.0 - (i as f64 + 0.5) / all.rows.len() as f64;
        let at = |v: f64| frame.point([x.place(v.max(x.range[0])).clamp(0.0, 1.0), height]);
        let solid = stroke(*style)
            .split(" stroke-dasharray")
            .next()
            .map(str::to_owned);
        let solid = solid.unwrap_or_default();
        let ([left, y], [right, _]) = (at(*low), at(*high));
        canvas.line([left, y], [right, y], &solid);
        for (x, is_inside) in [(left, *low >= x.range[0]), (right, *high <= x.range[1])] {
            if is_inside {
                canvas.line([x, y - 5.0], [x, y + 5.0], &solid);
            }
        }
        if middle.is_finite() {
            marker(canvas, *style, at(*middle));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_wrapped_to_their_group() {
        assert_eq!(wrapped("fireplace room", 60.0), ["fireplace", "room"]);
        assert_eq!(wrapped("fireplace room", 200.0), ["fireplace room"]);
        assert_eq!(wrapped("", 60.0), [""; 0]);
    }
}
