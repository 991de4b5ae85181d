//! `docs/features.md`: what every format's reader does with each feature, from the readers' own lists.

use std::path::Path;

use specula_scene::features::{FORMATS, Feature, Support};

use crate::Result;
use crate::generated::Generated;

const HEAD: &str = "\
# What is read of each format

Made by `cargo xtask tables` from the lists that the readers themselves are tested against. Where the
picture changes visibly, loading gives a warning that names the place in the file.
";

/// The document.
#[allow(clippy::unnecessary_wraps, reason = "a generator's type")]
pub(crate) fn generate(_root: &Path) -> Result<Vec<Generated>> {
    let mut text = HEAD.to_owned();
    for (format, features) in FORMATS {
        text += &section(format, features);
    }
    Ok(vec![Generated {
        path: "docs/features.md",
        text,
    }])
}

fn section(format: &str, features: &[Feature]) -> String {
    let count = |is: fn(&Support) -> bool| features.iter().filter(|f| is(&f.support)).count();
    let mut text = format!(
        "\n## {format}\n\n{} supported, {} approximated, {} refused.\n\n\
         | kind | feature | |\n|---|---|---|\n",
        count(|s| matches!(s, Support::Full)),
        count(|s| matches!(s, Support::Approximated(_))),
        count(|s| matches!(s, Support::Refused(_))),
    );
    for feature in features {
        let support = match feature.support {
            Support::Full => "supported".to_owned(),
            Support::Approximated(how) => format!("approximated: {how}"),
            Support::Refused(why) => format!("refused: {why}"),
        };
        text += &format!("| {} | {} | {support} |\n", feature.class, feature.name);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_format_has_a_section() {
        let documents = generate(Path::new("")).unwrap();
        for (format, features) in FORMATS {
            assert!(documents[0].text.contains(&format!("\n## {format}\n")));
            assert!(!features.is_empty());
        }
    }
}
