//! Puts icon, version and manifest into the Windows program; does nothing for other systems.

use std::io;

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-changed=src/build.rs");
    println!("cargo::rerun-if-changed=assets/windows");
    if std::env::var("CARGO_CFG_TARGET_OS").as_deref() != Ok("windows") {
        return Ok(());
    }
    // As on Linux: the main thread draws the window, and Windows gives it 1 or 2 MiB.
    let stack = if std::env::var("CARGO_CFG_TARGET_ENV").as_deref() == Ok("msvc") {
        "/STACK:8388608"
    } else {
        "-Wl,--stack,8388608"
    };
    println!("cargo::rustc-link-arg-bins={stack}");
    // Name, version and description are those of Cargo.toml.
    winresource::WindowsResource::new()
        .set_icon("assets/windows/icon.ico")
        .set_manifest_file("assets/windows/manifest.xml")
        .set("ProductName", "OPC UA Configurator")
        .set("FileDescription", "OPC UA Configurator")
        .set("OriginalFilename", "opcua-configurator.exe")
        .compile()
}
