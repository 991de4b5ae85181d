//! Values of options, with messages that say what was expected.

use std::path::PathBuf;
use std::time::Duration;

/// `30s`, `5m`, `1.5h`, `250ms`; a bare number is seconds.
pub(crate) fn duration(text: &str) -> Result<Duration, String> {
    time(text, |n| n > 0.0)?
        .ok_or_else(|| "expected a time above 0 and below a year, as in 30s, 5m, 1.5h".to_owned())
}

/// As [`duration`], from 0 on.
pub(crate) fn moment(text: &str) -> Result<Duration, String> {
    time(text, |n| n >= 0.0)?
        .ok_or_else(|| "expected a time from 0 to a year, as in 1.5s, 250ms".to_owned())
}

/// A number of frames per second.
pub(crate) fn rate(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok();
    number
        .filter(|n| (1e-3..=1e6).contains(n))
        .ok_or_else(|| "expected a number of frames per second above 0, as in 24".to_owned())
}

/// A time whose number holds a condition; `None` where it is none.
fn time(text: &str, holds: impl Fn(f64) -> bool) -> Result<Option<Duration>, String> {
    let split = text
        .find(|c: char| c.is_ascii_alphabetic())
        .unwrap_or(text.len());
    let (number, unit) = text.split_at(split);
    let factor = match unit {
        "ms" => 1e-3,
        "" | "s" => 1.0,
        "m" | "min" => 60.0,
        "h" => 3600.0,
        _ => return Err("expected a unit of ms, s, m or h, as in 30s, 5m, 1.5h".to_owned()),
    };
    let seconds = number
        .trim()
        .parse::<f64>()
        .ok()
        .filter(|n| holds(*n))
        .map(|n| n * factor)
        .filter(|s| *s <= 3.2e7);
    Ok(seconds.map(Duration::from_secs_f64))
}

/// `1280x720`.
pub(crate) fn resolution(text: &str) -> Result<[u32; 2], String> {
    text.split_once(['x', 'X', '×'])
        .and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]))
        .filter(|size: &[u32; 2]| size.iter().all(|s| (1..=65_536).contains(s)))
        .ok_or_else(|| "expected a width and a height from 1 to 65536, as in 1280x720".to_owned())
}

/// `x0,x1,y0,y1`.
pub(crate) fn crop(text: &str) -> Result<[u32; 4], String> {
    let numbers: Option<Vec<u32>> = text.split(',').map(|n| n.trim().parse().ok()).collect();
    let crop: Option<[u32; 4]> = numbers.and_then(|n| n.try_into().ok());
    crop.filter(|[x0, x1, y0, y1]| x0 < x1 && y0 < y1)
        .ok_or_else(|| {
            "expected four whole numbers x0,x1,y0,y1 with x0 < x1 and y0 < y1, as in 0,100,50,150"
                .to_owned()
        })
}

/// `4GiB`, `512MB`, `100k`; a bare number is bytes.
pub(crate) fn size(text: &str) -> Result<u64, String> {
    let split = text
        .find(|c: char| c.is_ascii_alphabetic())
        .unwrap_or(text.len());
    let (number, unit) = text.split_at(split);
    let factor: u64 = match unit.to_ascii_lowercase().as_str() {
        "" | "b" => 1,
        "k" | "kb" => 1000,
        "m" | "mb" => 1_000_000,
        "g" | "gb" => 1_000_000_000,
        "t" | "tb" => 1_000_000_000_000,
        "ki" | "kib" => 1 << 10,
        "mi" | "mib" => 1 << 20,
        "gi" | "gib" => 1 << 30,
        "ti" | "tib" => 1 << 40,
        _ => return Err("expected a unit such as MB, MiB, GB or GiB, as in 4GiB".to_owned()),
    };
    let number = number.trim().parse::<u64>().ok().filter(|n| *n > 0);
    number
        .and_then(|n| n.checked_mul(factor))
        .ok_or_else(|| "expected a whole number above 0 and a unit, as in 4GiB".to_owned())
}

/// A number of threads, or below 0, of cores to leave free.
pub(crate) fn threads(text: &str) -> Result<i16, String> {
    text.parse::<i16>()
        .ok()
        .filter(|n| *n != 0 && (-4096..=4096).contains(n))
        .ok_or_else(|| {
            "expected a number of threads from 1 to 4096, or of cores to leave free, such as -1"
                .to_owned()
        })
}

/// A number above 0.
pub(crate) fn positive(text: &str) -> Result<f32, String> {
    text.parse::<f32>()
        .ok()
        .filter(|v| v.is_finite() && *v > 0.0)
        .ok_or_else(|| "expected a number above 0".to_owned())
}

/// A number from -64 to 64.
pub(crate) fn finite(text: &str) -> Result<f32, String> {
    text.parse::<f32>()
        .ok()
        .filter(|v| (-64.0..=64.0).contains(v))
        .ok_or_else(|| "expected a number from -64 to 64".to_owned())
}

/// A number not below 0.
pub(crate) fn not_negative(text: &str) -> Result<f64, String> {
    text.parse::<f64>()
        .ok()
        .filter(|v| v.is_finite() && *v >= 0.0)
        .ok_or_else(|| "expected a number not below 0".to_owned())
}

/// A path that ends in `.exr` or `.png`.
pub(crate) fn picture(text: &str) -> Result<PathBuf, String> {
    with_extension(text, &["exr", "png"])
        .ok_or_else(|| "expected a file name that ends in .exr or .png".to_owned())
}

/// A path that ends in `.exr`, `.png` or `.film`.
pub(crate) fn output(text: &str) -> Result<PathBuf, String> {
    with_extension(text, &["exr", "png", "film"])
        .ok_or_else(|| "expected a file name that ends in .exr, .png or .film".to_owned())
}

/// `0..512`: numbers of samples, half open.
pub(crate) fn samples(text: &str) -> Result<[u32; 2], String> {
    const MOST: u32 = 1 << 24;
    text.split_once("..")
        .and_then(|(from, to)| Some([from.parse().ok()?, to.parse().ok()?]))
        .filter(|[from, to]| from < to && *to <= MOST)
        .ok_or_else(|| {
            "expected the first sample and the one after the last, at most 16777216, as in 512..1024"
                .to_owned()
        })
}

/// `0..16/256`: tiles of every so many, half open.
pub(crate) fn round_share(text: &str) -> Result<[u32; 3], String> {
    text.split_once('/')
        .and_then(|(share, of)| {
            let [from, to] = samples(share).ok()?;
            Some([from, to, of.parse().ok()?])
        })
        .filter(|[_, to, of]| to <= of)
        .ok_or_else(|| {
            "expected the first tile, the one after the last, and of how many, as in 0..16/256"
                .to_owned()
        })
}

/// A time, or `off`.
pub(crate) fn interval(text: &str) -> Result<Interval, String> {
    if text == "off" {
        return Ok(Interval(None));
    }
    duration(text)
        .map(|every| Interval(Some(every)))
        .map_err(|e| format!("{e}, or off"))
}

/// A time between two writes; `None`: never.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Interval(pub(crate) Option<Duration>);

/// A path that ends in `.png`.
pub(crate) fn png(text: &str) -> Result<PathBuf, String> {
    with_extension(text, &["png"])
        .ok_or_else(|| "expected a file name that ends in .png".to_owned())
}

/// `name=value`.
pub(crate) fn parameter(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.is_empty() => Ok((name.to_owned(), value.to_owned())),
        _ => Err("expected a name and its value, such as spp=64".to_owned()),
    }
}

/// A path that ends in `.pbrt`.
pub(crate) fn pbrt(text: &str) -> Result<PathBuf, String> {
    with_extension(text, &["pbrt"])
        .ok_or_else(|| "expected a file name that ends in .pbrt".to_owned())
}

fn with_extension(text: &str, allowed: &[&str]) -> Option<PathBuf> {
    let path = PathBuf::from(text);
    let extension = path.extension()?.to_str()?.to_ascii_lowercase();
    allowed.contains(&extension.as_str()).then_some(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters() {
        let pair = |a: &str, b: &str| Ok((a.to_owned(), b.to_owned()));
        assert_eq!(parameter("spp=64"), pair("spp", "64"));
        assert_eq!(parameter("file=a=b"), pair("file", "a=b"));
        assert!(parameter("spp").is_err() && parameter("=1").is_err());
    }

    #[test]
    fn sizes() {
        assert_eq!(size("10"), Ok(10));
        assert_eq!(size("4GiB"), Ok(4 << 30));
        assert_eq!(size("2 mb"), Ok(2_000_000));
        assert_eq!(size("3k"), Ok(3000));
        for bad in ["", "0", "-1", "4XB", "1.5GiB", "99999999TiB"] {
            assert!(size(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn times() {
        assert_eq!(duration("30s"), Ok(Duration::from_secs(30)));
        assert_eq!(duration("5m"), Ok(Duration::from_secs(300)));
        assert_eq!(duration("1.5h"), Ok(Duration::from_secs(5400)));
        assert_eq!(duration("250ms"), Ok(Duration::from_millis(250)));
        assert_eq!(duration("7"), Ok(Duration::from_secs(7)));
        for bad in [
            "", "s", "-3s", "0s", "5 weeks", "nans", "inf", "1e99h", "3s4",
        ] {
            assert!(duration(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn sizes_and_crops() {
        assert_eq!(resolution("640x360"), Ok([640, 360]));
        for bad in ["640", "640x", "0x5", "640x-1", "99999999x2", "axb"] {
            assert!(resolution(bad).is_err(), "{bad}");
        }
        assert_eq!(crop("0,10, 5,6"), Ok([0, 10, 5, 6]));
        for bad in ["", "1,2,3", "5,5,0,1", "0,1,9,2", "0,1,2,3,4", "a,b,c,d"] {
            assert!(crop(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn outputs_need_a_known_extension() {
        assert_eq!(output("a/b.EXR"), Ok(PathBuf::from("a/b.EXR")));
        for bad in ["a", "a.jpg", ".png", ""] {
            assert!(output(bad).is_err(), "{bad}");
        }
        assert!(png("a.exr").is_err());
    }
}
