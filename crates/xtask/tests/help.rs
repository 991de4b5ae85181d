//! The program as a person starts it: what help lists, and what a wrong word gets.

use std::process::{Command, Output};

fn xtask(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_xtask"));
    command
        .args(arguments)
        .output()
        .expect("the program starts")
}

#[test]
fn help_lists_the_chores_that_documents_name() {
    let output = xtask(&["help"]);
    assert!(output.status.success());
    let help = String::from_utf8(output.stdout).unwrap();
    let chores: Vec<_> = help
        .lines()
        .filter_map(|line| line.strip_prefix("  ")?.split_whitespace().next())
        .collect();
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
    let mut named = 0;
    for document in ["README.md", "CONTRIBUTING.md", "ARCHITECTURE.md"] {
        let text = std::fs::read_to_string(format!("{root}/{document}")).unwrap();
        for rest in text.split("cargo xtask ").skip(1) {
            let chore = rest.split(|c: char| !c.is_ascii_lowercase() && c != '-');
            let chore = chore.into_iter().next().unwrap();
            assert!(
                chores.contains(&chore),
                "{document} names `cargo xtask {chore}`"
            );
            named += 1;
        }
    }
    assert!(named > 3, "{named}");
}

#[test]
fn a_wrong_chore_is_an_error_of_usage() {
    let output = xtask(&["no-such-chore"]);
    assert_eq!(output.status.code(), Some(2));
    let error = String::from_utf8(output.stderr).unwrap();
    assert!(error.contains("no-such-chore"), "{error}");
}
