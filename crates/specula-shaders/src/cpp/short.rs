//! Functions and branches that only return a value, on one line.

/// Longest line that is made.
const WIDTH: usize = 120;

/// `head {`, `return value;` and `}` on one line, where they fit.
pub(super) fn joined(text: &str) -> String {
    let lines: Vec<&str> = text.lines().collect();
    let mut joined = String::with_capacity(text.len());
    let mut at = 0;
    while at < lines.len() {
        let one = one_line(&lines[at..]);
        at += if one.is_some() { 3 } else { 1 };
        joined += one.as_deref().unwrap_or(lines[at - 1]);
        joined.push('\n');
    }
    joined
}

fn one_line(lines: &[&str]) -> Option<String> {
    let [head, value, end, ..] = lines else {
        return None;
    };
    let start = head.trim_start();
    let indent = &head[..head.len() - start.len()];
    let is_head = start.starts_with("SPECULA_FN ") || start.starts_with("if (");
    let value = value.trim_start();
    let is_value = value.starts_with("return ") && value.ends_with(';');
    let is_end = end.strip_prefix(indent) == Some("}");
    let one = format!("{head} {value} }}");
    (is_head && head.ends_with(" {") && is_value && is_end && one.len() <= WIDTH).then_some(one)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_returns_a_value_is_one_line() {
        let text = "SPECULA_FN float f(float a) {\n    if (a > 1.0f) {\n        return 2.0f;\n    }\n    return a;\n}\n\n\
                    SPECULA_FN float g() {\n    return 1.0f;\n}\n";
        let expected = "SPECULA_FN float f(float a) {\n    if (a > 1.0f) { return 2.0f; }\n    return a;\n}\n\n\
                        SPECULA_FN float g() { return 1.0f; }\n";
        assert_eq!(joined(text), expected);
    }

    #[test]
    fn what_does_more_stays() {
        let long = format!(
            "SPECULA_FN float f() {{\n    return {};\n}}\n",
            "a".repeat(90)
        );
        for text in [
            "SPECULA_FN float f() {\n    return 1.0f; // Why.\n}\n",
            "    if (a) {\n        return 1.0f;\n    } else {\n        return 2.0f;\n    }\n",
            "    while (a) {\n        return 1.0f;\n    }\n",
            "SPECULA_FN void f(float& a) {\n    a = 1.0f;\n}\n",
            "SPECULA_FN float f() {\n",
            &long,
        ] {
            assert_eq!(joined(text), text);
        }
    }
}
