//! The page as it is written.

use std::fs;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use sha2::{Digest, Sha256};

use crate::folder::{Atlas, record_is_true, times};

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

/// What stands between two texts, of which each must be there.
fn between<'t>(text: &'t str, before: &str, after: &str) -> &'t str {
    text.split_once(before).unwrap().1.split_once(after).unwrap().0
}

fn manifest() -> Atlas {
    Atlas::new(MANIFEST)
}

#[test]
fn it_may_run_its_own_script_and_nothing_else() {
    let page = page(&manifest());
    let policy = between(&page, "http-equiv=\"Content-Security-Policy\" content=\"", "\"");
    let digest = |text: &str| format!("'sha256-{}'", BASE64_STANDARD.encode(Sha256::digest(text)));
    let script = between(&page, "<script type=\"module\">", "</script>");
    let style = between(&page, "<style>", "</style>");
    assert!(policy.starts_with("default-src 'none'; "), "{policy}");
    assert!(policy.contains(&format!("script-src 'self' {};", digest(script))), "{policy}");
    assert!(policy.contains(&format!("style-src {};", digest(style))), "{policy}");
    for wide in ["unsafe", "http:", "https:", "*"] {
        assert!(!policy.contains(wide), "{policy}");
    }
    // The names of the languages of SVG and XLink are no addresses of anything.
    let without_names = page.replace("http://www.w3.org/", "");
    assert!(!without_names.contains("http://") && !without_names.contains("https://"), "an address of another place");
    assert_eq!(page.matches("<script").count(), 2);
}

#[test]
fn text_of_the_manifest_is_text() {
    let page = page(&manifest());
    assert_eq!(between(&page, "<title>", "</title>"), "&lt;/script&gt;&lt;b&gt;T&lt;/b&gt; &amp; &quot;quotes&quot;");
    let atlas = between(&page, "<script type=\"application/json\" id=\"atlas\">", "</script>");
    assert!(!atlas.contains('<'));
    let atlas: serde_json::Value = serde_json::from_str(atlas).unwrap();
    assert_eq!(atlas["title"], "</script><b>T</b> & \"quotes\"");
    assert_eq!(atlas["families"][0]["title"], "<img src=x onerror=alert(1)>");
    assert_eq!(atlas["families"][0]["curves"], 1);
    assert_eq!(atlas["families"][0]["page_format"], "svg");
    let measures = atlas["measures"].as_array().unwrap();
    assert_eq!(measures.len(), coupler_curves::measure::ALL.len());
}

#[test]
fn a_second_run_leaves_it_alone_and_one_that_was_edited_is_written_again() {
    let atlas = manifest();
    let first = page(&atlas);
    let before = times(&atlas.out());
    assert_eq!(page(&atlas), first);
    assert_eq!(times(&atlas.out()), before);
    record_is_true(&atlas.out());
    fs::write(atlas.out().join("index.html"), "edited").unwrap();
    fs::remove_file(atlas.out().join("evans/gallery.js")).unwrap();
    assert_eq!(page(&atlas), first);
    record_is_true(&atlas.out());
}

#[test]
fn it_has_the_families_of_all_runs_into_its_folder() {
    let atlas = manifest();
    let one = page(&atlas);
    assert!(!one.contains("\"bare\""));
    let (code, _, err) = atlas.run(&["--only", "bare"]);
    assert_eq!(code, 0, "{err}");
    let both = fs::read_to_string(atlas.out().join("index.html")).unwrap();
    assert!(both.contains("evans/gallery.js") && both.contains("bare/gallery.js"));
}
