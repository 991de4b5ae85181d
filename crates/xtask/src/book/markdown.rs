//! Links, anchors and inclusions of a Markdown text.

use std::ops::Range;

use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};

/// What a document points at, with its lines, and what it can be pointed at by.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct Document {
    /// Targets of links and pictures, as written.
    pub(super) links: Vec<(usize, String)>,
    /// Targets of mdBook's `{{#include}}`.
    pub(super) inclusions: Vec<(usize, String)>,
    /// Identifiers of the headings, as mdBook and GitHub make them.
    pub(super) anchors: Vec<String>,
}

/// Reads a document.
pub(super) fn read(text: &str) -> Document {
    let mut document = Document::default();
    let mut heading: Option<String> = None;
    let options = Options::ENABLE_TABLES | Options::ENABLE_FOOTNOTES;
    for (event, range) in Parser::new_ext(text, options).into_offset_iter() {
        match event {
            Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => {
                document
                    .links
                    .push((line_of(text, &range), dest_url.into_string()));
            }
            Event::Start(Tag::Heading { .. }) => heading = Some(String::new()),
            Event::End(TagEnd::Heading(_)) => {
                let content = heading.take().unwrap_or_default();
                document.add_anchor(&content);
            }
            Event::Text(part) | Event::Code(part) => {
                if let Some(content) = &mut heading {
                    content.push_str(&part);
                }
            }
            Event::Html(html) | Event::InlineHtml(html) => {
                let line = line_of(text, &range);
                for name in ["src", "href"] {
                    let found = attributes(&html, name);
                    document
                        .links
                        .extend(found.map(|target| (line, target.to_owned())));
                }
                document
                    .anchors
                    .extend(attributes(&html, "id").map(str::to_owned));
            }
            _ => {}
        }
    }
    document.inclusions = inclusions(text);
    document
}

impl Document {
    /// Names a heading; one that has been named before gets a number.
    fn add_anchor(&mut self, content: &str) {
        let id = anchor(content);
        let taken = |id: &str| self.anchors.iter().any(|a| a == id);
        let unique = (1_u32..).map(|n| format!("{id}-{n}")).find(|id| !taken(id));
        let id = if taken(&id) {
            unique.unwrap_or_default()
        } else {
            id
        };
        self.anchors.push(id);
    }
}

/// The identifier of a heading.
fn anchor(heading: &str) -> String {
    heading
        .trim()
        .chars()
        .filter_map(|c| match c {
            _ if c.is_alphanumeric() || c == '_' || c == '-' => Some(c),
            _ if c.is_whitespace() => Some('-'),
            _ => None,
        })
        .flat_map(char::to_lowercase)
        .collect()
}

/// Values of an attribute in HTML, as written between double quotes.
pub(super) fn attributes<'a>(html: &'a str, name: &str) -> impl Iterator<Item = &'a str> {
    let start = format!(" {name}=\"");
    let mut rest = html;
    std::iter::from_fn(move || {
        let at = rest.find(&start)? + start.len();
        let (value, after) = rest[at..].split_once('"')?;
        rest = after;
        Some(value)
    })
}

fn line_of(text: &str, range: &Range<usize>) -> usize {
    1 + text[..range.start].matches('\n').count()
}

/// Files that mdBook includes: the path before `:`, with which lines or anchors are chosen.
fn inclusions(text: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    for (number, line) in (1..).zip(text.lines()) {
        for part in line.split("{{#").skip(1) {
            let inside = part.split("}}").next().unwrap_or("");
            let mut words = inside.split_whitespace();
            if matches!(words.next(), Some("include" | "rustdoc_include")) {
                let path = words.next().unwrap_or("").split(':').next().unwrap_or("");
                found.push((number, path.to_owned()));
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_pictures_and_anchors_are_found_with_their_lines() {
        let text = "# A `b` & c\n\nSee [x](y.md#z)\nand ![p](p.png).\n\n```\n[no](no.md)\n```\n\n\
                    ## Twice\n## Twice\n\n<img src=\"q.png\" id=\"q\">\n\n[r]\n\n[r]: s.md\n\n`[no](no.md)`\n";
        let document = read(text);
        let links = [(3, "y.md#z"), (4, "p.png"), (13, "q.png"), (15, "s.md")];
        assert_eq!(document.links, links.map(|(n, t)| (n, t.to_owned())));
        assert_eq!(document.anchors, ["a-b--c", "twice", "twice-1", "q"]);
    }

    #[test]
    fn inclusions_are_found_without_their_ranges() {
        let text =
            "```rust\n{{#include ../a.rs:3:9}}\n```\n{{#rustdoc_include b.rs}} {{#title c}}\n";
        let expected = [(2, "../a.rs".to_owned()), (4, "b.rs".to_owned())];
        assert_eq!(read(text).inclusions, expected);
    }
}
