//! `kernel.js`, the script with the kernel, which the page loads when it first computes with a linkage.

use std::sync::LazyLock;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde_json::{Value, json};

use super::family_script::statement;
use crate::record::Digest;

/// The name of the script in the folder of the atlas.
pub const KERNEL_FILE: &str = "kernel.js";

/// The kernel, `coupler-kernel` for WebAssembly, compressed with gzip; `.ci/kernel update` writes it.
pub const KERNEL: &[u8] = include_bytes!("kernel.wasm.gz");

/// SHA-256 of [`KERNEL`]. The page and the script have it, so that the page takes no kernel of another version.
pub(super) fn kernel_digest() -> Digest {
    static DIGEST: LazyLock<Digest> = LazyLock::new(|| Digest::of(KERNEL));
    *DIGEST
}

/// What the script says: the kernel, and its digest.
pub(super) fn kernel_file() -> Value {
    json!({ "sha256": kernel_digest().to_string(), "module": BASE64_STANDARD.encode(KERNEL) })
}

/// The text of `kernel.js`.
pub fn kernel_script() -> String {
    statement("kernel", &kernel_file())
}
