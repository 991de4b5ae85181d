//! The library's shaders as pages get them.

use specula_shaders::Language;
use specula_studio::Studio;

fn ask(request: &str) -> Result<(String, usize), String> {
    let answer = Studio::default().try_answer(request.as_bytes());
    let answer = answer.map_err(|e| e.to_string())?;
    let text = answer.value()["wgsl"].as_str().expect("a text").to_owned();
    let tables = answer.array("tables").map_or(0, |(_, bytes)| bytes.len());
    Ok((text, tables))
}

#[test]
fn the_whole_library_is_what_export_writes() {
    let (text, tables) = ask(r#"{"ask": "shaders.library"}"#).expect("a library");
    let files = specula_shaders::export(Language::Wgsl, &[]).expect("exported");
    assert!(text.as_bytes() == files[0].bytes);
    assert_eq!(tables % 4, 0);
    assert!(tables > 100_000);
}

#[test]
fn functions_come_with_what_they_call_and_nothing_else() {
    let request = r#"{"ask": "shaders.library", "functions": ["bounded_sample_direction"]}"#;
    let (text, tables) = ask(request).expect("a function");
    assert!(text.contains("fn bounded_sample_direction("));
    assert!(!text.contains("fn heitz_sample_wm("));
    assert_eq!(tables, 0, "no table is read");
}

#[test]
fn a_name_that_is_no_function_is_named() {
    let error = ask(r#"{"ask": "shaders.library", "functions": ["bound"]}"#).unwrap_err();
    assert!(error.contains("`bound`"), "{error}");
    let error = ask(r#"{"ask": "shaders.library", "modules": []}"#).unwrap_err();
    assert!(error.contains("modules"), "{error}");
}
