//! Allows undefined Python symbols in the extension module on macOS, which Linux allows by default.

fn main() {
    pyo3_build_config::add_extension_module_link_args();
}
