//! The example that reads surface files, from the outside: `mtm_zddp --surface`.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::common::example;

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/surfaces").join(name)
}

/// One line on standard error, status 2.
fn refused(output: &Output, expected: &str) {
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert!(message.lines().count() == 1 && message.contains(expected), "{expected}: {message}");
}

#[test]
fn any_file_can_be_the_disc_of_the_test_rig() {
    let program = example("mtm_zddp");
    let folder = tempfile::tempdir().unwrap();
    let with = |surface: &Path| {
        Command::new(&program)
            .args(["--quick", "--grid", "32", "--steps", "1", "--surface"])
            .arg(surface)
            .arg("--out")
            .arg(folder.path())
            .output()
            .unwrap()
    };
    // the small files cover a few micrometres; with other spacings they cover enough
    let wide = stribeck::surface::read(data("cut.x3p")).unwrap().with_spacing(3e-6, 5e-6).unwrap();
    let (x3p, text) = (folder.path().join("wide.x3p"), folder.path().join("wide.txt"));
    stribeck::surface::write_x3p(&x3p, &wide).unwrap();
    stribeck::surface::write_text(&text, &wide).unwrap();
    let npy = folder.path().join("nodes.npy");
    stribeck::surface::write_npy(&npy, 32, 32, &[0.0; 1024]).unwrap();
    for file in [x3p, text, npy, data("compressed.sur"), data("binary.sdf"), data("cut.plu")] {
        let output = with(&file);
        assert!(output.status.success(), "{}: {output:?}", file.display());
    }
    refused(&with(&data("cut.x3p")), "repeated more often");
    refused(&with(&data("README.md")), "README.md");
    let small = folder.path().join("small.npy");
    stribeck::surface::write_npy(&small, 2, 2, &[0.0; 4]).unwrap();
    refused(&with(&small), "2 x 2 heights without spacing");
}
