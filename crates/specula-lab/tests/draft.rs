//! Every experiment at draft quality: the direction of every claim, and what it leaves.

use std::path::Path;
use std::sync::atomic::AtomicBool;

use specula_lab::{Answer, ClaimKind, Quality, Record, RunOptions, experiments, run};

/// Runs all of them; the records are read back from their files.
#[test]
fn claims_come_out_as_they_are_known_to() {
    let folder = tempfile::tempdir().unwrap();
    let all = experiments::named(&[]).unwrap();
    let options = RunOptions {
        quality: Quality::Draft,
        seed: 1,
    };
    let records = run(
        &all,
        options,
        folder.path(),
        &AtomicBool::new(false),
        &|_| (),
    )
    .unwrap();
    let mut wrong = Vec::new();
    for (experiment, record) in all.iter().zip(&records) {
        let place = folder.path().join(experiment.id);
        assert_eq!(&Record::read(&place).unwrap().id, experiment.id);
        files_are_there(&place, record);
        assert!(
            !record.verdict.claims.is_empty(),
            "{}: no claims",
            record.id
        );
        for claim in &record.verdict.claims {
            let expected = match claim.kind {
                ClaimKind::Law => Answer::Yes,
                ClaimKind::Refuted => Answer::No,
                ClaimKind::Measured => continue,
            };
            if claim.holds != expected {
                wrong.push(format!(
                    "{}: {}: {}",
                    record.id, claim.statement, claim.measured
                ));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Files that the record names are there and not empty.
fn files_are_there(folder: &Path, record: &Record) {
    let tables = record.tables.iter().map(|t| format!("{}.csv", t.name));
    let plots = record
        .plots
        .iter()
        .flat_map(|p| [p.svg.clone(), p.png.clone()]);
    let pictures = record.comparisons.iter().flat_map(|c| {
        let shots = c.shots.iter().flat_map(|s| [s.png.clone(), s.exr.clone()]);
        shots.chain([c.sheet.clone()])
    });
    for name in tables.chain(plots).chain(pictures) {
        let length = std::fs::metadata(folder.join(&name)).map(|m| m.len());
        assert!(length.is_ok_and(|l| l > 0), "{}: {name}", record.id);
    }
}

/// Files and names agree: `tokuyoshi24-fig7` is in `tokuyoshi24_fig7.rs`.
#[test]
fn every_experiment_has_a_file_of_its_name() {
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/experiments");
    let mut ids: Vec<&str> = experiments::ALL.iter().map(|e| e.id).collect();
    for id in &ids {
        let file = sources.join(format!("{}.rs", id.replace('-', "_")));
        assert!(file.is_file(), "{}", file.display());
    }
    let count = ids.len();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), count, "names are unique");
}
