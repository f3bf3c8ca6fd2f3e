//! The page that the program writes, `index.html`, and the script with its kernel, `kernel.js`.

use std::fs;
use std::io::Read;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use coupler_atlas::gallery::{KERNEL, join_modules, kernel_script, scripts};
use flate2::read::GzDecoder;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use crate::support::command::run;
use crate::support::folder::{Atlas, check_record, edit_record, times};

const MANIFEST: &str = r#"[atlas]
title = "</script><b>T</b> & \"quotes\""
output = "out"
[[family]]
id = "evans"
linkage = "evans"
title = "<img src=x onerror=alert(1)>"
sampling = { step = "10 deg" }
cases = [{ p = 2, a = 2.5 }]
[[family]]
id = "bare"
linkage = "evans"
sampling = { step = "10 deg" }
cases = [{ p = 2, a = 2.5 }]
"#;

fn page(atlas: &Atlas) -> String {
    let (code, _, err) = atlas.run(&["--only", "evans"]);
    assert_eq!(code, 0, "{err}");
    fs::read_to_string(atlas.out().join("index.html")).unwrap()
}

/// The text between two others.
///
/// # Panics
///
/// If one of them is missing.
fn between<'t>(text: &'t str, before: &str, after: &str) -> &'t str {
    text.split_once(before).unwrap().1.split_once(after).unwrap().0
}

fn new_atlas() -> Atlas {
    Atlas::new(MANIFEST)
}

#[test]
fn the_page_allows_its_own_script_and_style_only() {
    let page = page(&new_atlas());
    let policy = between(&page, "http-equiv=\"Content-Security-Policy\" content=\"", "\"");
    let digest = |text: &str| format!("'sha256-{}'", BASE64_STANDARD.encode(Sha256::digest(text)));
    let loader = between(&page, "<script type=\"module\">", "</script>");
    let unpacked = |id: &str| {
        let packed = between(&page, &format!("<script type=\"application/octet-stream\" id=\"{id}\">"), "</script>");
        let mut text = String::new();
        GzDecoder::new(&BASE64_STANDARD.decode(packed).unwrap()[..]).read_to_string(&mut text).unwrap();
        text
    };
    let (script, style) = (unpacked("script"), unpacked("style"));
    assert_eq!(script, join_modules(scripts()));
    assert!(policy.starts_with("default-src 'none'; "), "{policy}");
    assert!(
        policy.contains(&format!("script-src 'self' 'wasm-unsafe-eval' {} {};", digest(loader), digest(&script))),
        "{policy}"
    );
    assert!(policy.contains(&format!("style-src {};", digest(&style))), "{policy}");
    let policy = policy.replace("'wasm-unsafe-eval'", "");
    for wide in ["unsafe", "http:", "https:", "*"] {
        assert!(!policy.contains(wide), "{policy}");
    }
    // The namespaces of SVG and XLink are not links.
    let without_namespaces = format!("{page}{script}{style}").replace("http://www.w3.org/", "");
    assert!(
        !without_namespaces.contains("http://") && !without_namespaces.contains("https://"),
        "the page has a link to another site"
    );
    assert_eq!(page.matches("<script").count(), 4);
}

#[test]
fn the_page_is_small_and_names_the_kernel_next_to_it() {
    let atlas = new_atlas();
    let page = page(&atlas);
    assert!(page.len() <= 200_000, "the page has {} bytes", page.len());
    let script = fs::read_to_string(atlas.out().join("kernel.js")).unwrap();
    assert_eq!(script, kernel_script());
    let kernel: Value = serde_json::from_str(between(&script, "couplerAtlas.kernel(", ");\n")).unwrap();
    assert_eq!(BASE64_STANDARD.decode(kernel["module"].as_str().unwrap()).unwrap(), KERNEL);
    let sha256 = format!("{:x}", Sha256::digest(KERNEL));
    assert_eq!(kernel["sha256"], sha256);
    assert_eq!(data_of(&page)["kernel"], json!({ "script": "kernel.js", "sha256": sha256 }));
}

/// The summary of the atlas in the page.
fn data_of(page: &str) -> Value {
    let data = between(page, "<script type=\"application/json\" id=\"atlas\">", "</script>");
    assert!(!data.contains('<'));
    serde_json::from_str(data).unwrap()
}

#[test]
fn text_of_the_manifest_is_escaped() {
    let page = page(&new_atlas());
    assert_eq!(between(&page, "<title>", "</title>"), "&lt;/script&gt;&lt;b&gt;T&lt;/b&gt; &amp; &quot;quotes&quot;");
    let atlas = data_of(&page);
    assert_eq!(atlas["title"], "</script><b>T</b> & \"quotes\"");
    assert_eq!(atlas["families"][0]["title"], "<img src=x onerror=alert(1)>");
    assert_eq!(atlas["families"][0]["curves"], 1);
    assert_eq!(atlas["families"][0]["page_format"], "svg");
    let measures = atlas["measures"].as_array().unwrap();
    assert_eq!(measures.len(), coupler_curves::measure::ALL.len());
}

#[test]
fn a_second_run_keeps_what_is_unchanged_and_restores_what_is_edited_or_missing() {
    let atlas = new_atlas();
    let first = page(&atlas);
    let before = times(&atlas.out());
    assert_eq!(page(&atlas), first);
    assert_eq!(times(&atlas.out()), before);
    check_record(&atlas.out());
    fs::write(atlas.out().join("index.html"), "edited").unwrap();
    fs::remove_file(atlas.out().join("evans/gallery.js")).unwrap();
    fs::write(atlas.out().join("kernel.js"), "edited").unwrap();
    assert_eq!(page(&atlas), first);
    check_record(&atlas.out());
    fs::remove_file(atlas.out().join("kernel.js")).unwrap();
    assert_eq!(page(&atlas), first);
    assert!(fs::read_to_string(atlas.out().join("kernel.js")).unwrap() == kernel_script());
    check_record(&atlas.out());
}

#[test]
fn a_check_finds_a_page_or_a_kernel_that_is_edited_missing_or_not_recorded() {
    let atlas = new_atlas();
    assert_eq!(atlas.run(&[]).0, 0);
    let check = || run(atlas.0.path(), &["check", "--against", "out"]);
    assert_eq!(check().0, 0);
    for (name, key) in [("index.html", "gallery"), ("kernel.js", "kernel")] {
        let (path, record) = (atlas.out().join(name), atlas.out().join("run.json"));
        let [text, recorded] = [&path, &record].map(|path| fs::read(path).unwrap());
        let is_found = |change: &str| {
            let (code, out, err) = check();
            assert!(code == 1 && out.contains(name), "{change}: {out}{err}");
        };
        fs::write(&path, "edited").unwrap();
        is_found("edited");
        fs::remove_file(&path).unwrap();
        is_found("missing");
        fs::write(&path, text).unwrap();
        edit_record(&atlas.out(), |run| drop(run.as_object_mut().unwrap().remove(key)));
        is_found("not recorded");
        fs::write(&record, recorded).unwrap();
    }
}

#[test]
fn the_page_lists_the_families_of_all_runs_into_its_folder() {
    let atlas = new_atlas();
    let first = page(&atlas);
    assert!(!first.contains("\"bare\""));
    let (code, _, err) = atlas.run(&["--only", "bare"]);
    assert_eq!(code, 0, "{err}");
    let both = fs::read_to_string(atlas.out().join("index.html")).unwrap();
    assert!(both.contains("evans/gallery.js") && both.contains("bare/gallery.js"));
}
