//! `cargo xtask licences`: checks that every package in the lock file, on every platform, may be distributed with this
//! program.

use std::path::Path;

use serde_json::Value;
use spdx::{Expression, LicenseReq};

use crate::command;

/// Licences that require no more than a notice. CDLA-Permissive-2.0 is a licence for data, such as a list of
/// certificate authorities. MPL-2.0 and the GPL family are excluded, because they would put conditions on users of this
/// library.
const ALLOWED: &[&str] = &[
    "0BSD",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "CC0-1.0",
    "CDLA-Permissive-2.0",
    "ISC",
    "MIT",
    "MIT-0",
    "Unicode-3.0",
    "Unlicense",
    "Zlib",
];

/// Checks all packages that `cargo metadata` lists.
///
/// # Errors
/// A message for each package whose licence is not allowed, cannot be read or is not stated.
pub(crate) fn check(root: &Path) -> Result<String, String> {
    verdict(&command::metadata(root, "--all-features")?)
}

fn verdict(metadata: &Value) -> Result<String, String> {
    let packages = metadata["packages"]
        .as_array()
        .filter(|packages| !packages.is_empty())
        .ok_or("`cargo metadata` lists no packages")?;
    let faults: Vec<String> = packages.iter().filter_map(fault).collect();
    if faults.is_empty() {
        return Ok(format!("{} packages, each under an allowed licence", packages.len()));
    }
    Err(format!(
        "{}\nhint: choose another crate, or add the licence to ALLOWED in crates/xtask/src/licences.rs",
        faults.join("\n")
    ))
}

/// A message that names a package and the problem with its licence, if there is one.
fn fault(package: &Value) -> Option<String> {
    let name = package["name"].as_str().unwrap_or("(unnamed)");
    let version = package["version"].as_str().unwrap_or("?");
    let Some(licence) = package["license"].as_str() else {
        return Some(format!("crate {name} {version} states no licence"));
    };
    let allowed = |asked: &LicenseReq| ALLOWED.contains(&asked.to_string().as_str());
    match Expression::parse_mode(licence, spdx::ParseMode::LAX) {
        Ok(expression) if expression.evaluate(allowed) => None,
        Ok(_) => Some(format!("crate {name} {version} is under `{licence}`, which is not allowed")),
        Err(why) => Some(format!("crate {name} {version} states the licence `{licence}`: {}", why.reason)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn allowed_packages_are_counted() {
        let metadata = json!({"packages": [
            {"name": "a", "version": "1.0.0", "license": "MIT OR Apache-2.0"},
            {"name": "b", "version": "2.0.0", "license": "GPL-3.0-only OR BSD-2-Clause"},
        ]});
        assert_eq!(verdict(&metadata), Ok("2 packages, each under an allowed licence".to_owned()));
    }

    #[test]
    fn each_faulty_package_is_named() {
        let metadata = json!({"packages": [
            {"name": "fine", "version": "1.0.0", "license": "ISC"},
            {"name": "copyleft", "version": "1.2.3", "license": "GPL-3.0-only"},
            {"name": "silent", "version": "0.1.0", "license": null},
            {"name": "garbled", "version": "0.2.0", "license": "MIT OR"},
        ]});
        let sentences = verdict(&metadata).unwrap_err();
        assert!(sentences.contains("crate copyleft 1.2.3 is under `GPL-3.0-only`, which is not allowed"));
        assert!(sentences.contains("crate silent 0.1.0 states no licence"));
        assert!(sentences.contains("crate garbled 0.2.0 states the licence `MIT OR`: "));
        assert!(!sentences.contains("fine"));
    }

    #[test]
    fn an_empty_answer_does_not_pass() {
        assert!(verdict(&json!({})).is_err());
        assert!(verdict(&json!({"packages": []})).is_err());
    }
}
