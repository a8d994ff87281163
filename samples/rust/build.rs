// SPDX-License-Identifier: MIT
// Where libmeshrepair.so is, unless it is where the linker looks anyway: MESHREPAIR_LIB_DIR.
fn main() {
    println!("cargo:rerun-if-env-changed=MESHREPAIR_LIB_DIR");
    if let Ok(folder) = std::env::var("MESHREPAIR_LIB_DIR") {
        println!("cargo:rustc-link-search=native={folder}");
        println!("cargo:rustc-link-arg=-Wl,-rpath,{folder}");
    }
}
