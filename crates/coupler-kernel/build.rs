//! Records what the kernel is built from and with.

#[path = "build/sources.rs"]
mod sources;

use std::env;
use std::path::Path;
use std::process::Command;

fn main() {
    let package = env::var_os("CARGO_MANIFEST_DIR").expect("cargo sets CARGO_MANIFEST_DIR");
    let workspace = Path::new(&package).join("../..");
    let digest = sources::digest(&workspace).expect("the workspace can be read");
    let compiler = Command::new(env::var_os("RUSTC").expect("cargo sets RUSTC")).arg("--version").output();
    let compiler = String::from_utf8(compiler.expect("the compiler runs").stdout).expect("its version is text");
    println!("cargo::rustc-env=KERNEL_SOURCES={digest}");
    println!("cargo::rustc-env=KERNEL_COMPILER={}", compiler.trim());
    for place in ["Cargo.toml", "Cargo.lock", "crates"] {
        println!("cargo::rerun-if-changed={}", workspace.join(place).display());
    }
}
