//! An atlas rendered for a test, and the files in its folder.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::SystemTime;

use sha2::{Digest, Sha256};
use tempfile::TempDir;

use super::command::{self, Ran};

/// A manifest in a temporary folder; its atlas is written to `out` in the same folder.
pub struct Atlas(pub TempDir);

impl Atlas {
    pub fn new(manifest: &str) -> Atlas {
        Atlas(command::folder_with(manifest))
    }

    /// The atlas of a manifest after a run with arguments, which must succeed.
    #[track_caller]
    pub fn rendered(manifest: &str, arguments: &[&str]) -> Atlas {
        let atlas = Atlas::new(manifest);
        let (code, _, err) = atlas.run(arguments);
        assert_eq!(code, 0, "{err}\n{manifest}");
        atlas
    }

    pub fn edit(&self, manifest: &str) {
        fs::write(self.0.path().join("atlas.toml"), manifest).unwrap();
    }

    pub fn out(&self) -> std::path::PathBuf {
        self.0.path().join("out")
    }

    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = command::program(self.0.path());
        command.arg("render").args(arguments);
        command
    }

    /// What a run returns.
    pub fn run(&self, arguments: &[&str]) -> Ran {
        command::result(self.command(arguments).output().unwrap())
    }

    /// What `check` of the atlas with more arguments returns.
    pub fn check(&self, arguments: &[&str]) -> Ran {
        command::run(self.0.path(), &[&["check", "--against", "out"], arguments].concat())
    }

    /// A file of the atlas, as text.
    #[track_caller]
    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.out().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }
}

/// Edits the record in a folder. It is then one of before records had a digest of themselves, which tells that they are edited.
pub fn edit_record(out: &Path, change: impl FnOnce(&mut serde_json::Value)) {
    let path = out.join("run.json");
    let mut run: serde_json::Value = serde_json::from_slice(&fs::read(&path).unwrap()).unwrap();
    change(&mut run);
    run.as_object_mut().unwrap().remove("sha256");
    fs::write(path, serde_json::to_vec_pretty(&run).unwrap()).unwrap();
}

/// The files below a folder, by their paths from there.
pub fn files(folder: &Path) -> Vec<String> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).into_iter().flatten() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if path.is_dir() {
            found.extend(files(&path).into_iter().map(|file| format!("{name}/{file}")));
        } else {
            found.push(name);
        }
    }
    found.sort();
    found
}

/// When each file below a folder was written.
pub fn times(folder: &Path) -> BTreeMap<String, SystemTime> {
    let time = |name: String| (name.clone(), fs::metadata(folder.join(name)).unwrap().modified().unwrap());
    files(folder).into_iter().map(time).collect()
}

/// The bytes of each file below a folder.
pub fn tree(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    files(folder).into_iter().map(|name| (name.clone(), fs::read(folder.join(name)).unwrap())).collect()
}

/// Asserts that every digest in `run.json` is that of its file, that every file it records as written exists, and that
/// every file is complete. Returns the number of files recorded as written.
pub fn check_record(out: &Path) -> usize {
    let found = tree(out);
    let mut recorded = 0;
    if let Some(text) = found.get("run.json") {
        let record: serde_json::Value = serde_json::from_slice(text).unwrap();
        let family_files = record["families"].as_array().unwrap().iter().flat_map(|family| {
            let folder = format!("{}/", family["id"].as_str().unwrap());
            family["files"].as_array().unwrap().iter().map(move |file| (folder.clone(), file))
        });
        let book_files = record["book"]["files"].as_array().into_iter().flatten().map(|file| (String::new(), file));
        let gallery_files = [&record["gallery"], &record["kernel"]].into_iter().filter(|file| file.is_object());
        let gallery_files = gallery_files.map(|file| (String::new(), file));
        for (folder, file) in family_files.chain(book_files).chain(gallery_files) {
            let name = folder + file["name"].as_str().unwrap();
            let is_written = !file["inputs_sha256"].is_null();
            recorded += usize::from(is_written);
            assert!(!is_written || found.contains_key(&name), "{name} is recorded but does not exist");
            if let Some(sha256) = file["sha256"].as_str() {
                assert_eq!(format!("{:x}", Sha256::digest(&found[&name])), sha256, "{name}");
            }
        }
    }
    // Files of a test itself may have the names of pages.
    for (name, bytes) in found.iter().filter(|(_, bytes)| *bytes != b"mine") {
        let end: &[u8] = match name.rsplit('.').next().unwrap() {
            "svg" => b"</svg>\n",
            "png" => b"IEND\xaeB`\x82",
            "pdf" => b"%%EOF",
            "csv" | "json" => b"\n",
            "html" => b"</html>\n",
            "js" => b");\n",
            _ => b"",
        };
        assert!(bytes.ends_with(end), "{name} is incomplete");
    }
    recorded
}

/// Updates the digest of a table in the record, so that only its contents show that it was edited.
pub fn update_digest(out: &Path, family: &str, table: &str) {
    let digest = format!("{:x}", Sha256::digest(fs::read(out.join(family).join(table)).unwrap()));
    edit_record(out, |run| {
        let families = run["families"].as_array_mut().unwrap();
        let entry = families.iter_mut().find(|entry| entry["id"] == family).unwrap();
        let file = entry["files"].as_array_mut().unwrap().iter_mut().find(|file| file["name"] == table).unwrap();
        file["sha256"] = digest.into();
    });
}
