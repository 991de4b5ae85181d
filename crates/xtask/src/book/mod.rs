//! `cargo xtask book`: the guide as a book, its links checked, its pictures made.
//!
//! The book's pages are the repository's own documents. [`summary`] reads which ones and in which order,
//! [`links`] checks them, [`stage`] copies them to a folder for mdBook with all that they show or include,
//! [`html`] checks what mdBook made of them. [`pictures`], [`distribution`], [`ball`] and [`table_of_gold`]
//! make what the pages show.

mod ball;
mod distribution;
mod html;
mod install;
mod links;
mod markdown;
mod pictures;
mod stage;
mod summary;
mod table_of_gold;

use std::path::Path;

use crate::Result;

/// Where the book is built, from the workspace's root.
const BUILT: &str = "target/book";

/// What to do with the book.
#[derive(clap::Args, Default)]
pub(crate) struct Book {
    /// Check links and pictures, and build nothing
    #[arg(long)]
    check: bool,
    /// Open the book in a browser
    #[arg(long, conflicts_with = "check")]
    open: bool,
    /// Make the pictures anew instead: all, or those with TEXT in their names
    #[arg(long, value_name = "TEXT", num_args = 0..=1, default_missing_value = "",
          conflicts_with_all = ["check", "open"])]
    pictures: Option<String>,
}

/// Does what was asked for.
pub(crate) fn run(root: &Path, book: &Book) -> Result<()> {
    if let Some(part) = &book.pictures {
        return pictures::make(root, part);
    }
    let summary = summary::read(root)?;
    let mut findings = links::find(root, &summary)?;
    findings.extend(pictures::find(root, &summary)?);
    report(&findings)?;
    println!("{} pages have no dead link", summary.pages.len());
    if book.check {
        return Ok(());
    }
    let program = install::mdbook(root)?;
    let staged = stage::make(root, &summary)?;
    let built = root.join(BUILT);
    let mut build = std::process::Command::new(program);
    build
        .arg("build")
        .arg(&staged)
        .arg("--dest-dir")
        .arg(&built);
    if book.open {
        build.arg("--open");
    }
    if !build.status()?.success() {
        return Err("mdBook failed".into());
    }
    report(&html::find(&built)?)?;
    println!("the book is {}", built.join("index.html").display());
    Ok(())
}

fn report(findings: &[String]) -> Result<()> {
    match findings.len() {
        0 => Ok(()),
        n => Err(format!("{}\n{n} findings", findings.join("\n")).into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::workspace;

    #[test]
    fn the_repository_has_no_dead_link_and_every_page_its_picture() {
        let root = workspace::root();
        let summary = summary::read(&root).unwrap();
        assert!(summary.pages.len() > 60, "{}", summary.pages.len());
        assert_eq!(links::find(&root, &summary).unwrap(), [""; 0]);
        assert_eq!(pictures::find(&root, &summary).unwrap(), [""; 0]);
    }
}
