//! Ensembles: the order and the numbers do not depend on threads, failures stay alone, stopped ones go on.

use stribeck::sim::Scene;
use stribeck::sim::ensemble::{self, Member, Outcome};

/// Two seeds that run, one scene that cannot be built, one whose first step fails.
fn members(steps: u64) -> Vec<Member> {
    let member = |name: &str, seed, change: fn(&mut Scene)| {
        let mut scene = Scene::azam_2019(24).with_tribofilm();
        scene.solver.tolerance = 1e-3;
        change(&mut scene);
        scene.track.seed = seed;
        Member::new(name.to_owned(), scene, steps, 60.0)
    };
    vec![
        member("first", 1, |_| {}),
        member("broken", 2, |scene| scene.elastic.equivalent_modulus = f64::NAN),
        member("hopeless", 3, |scene| {
            // No iterations, no convergence.
            scene.solver.max_iterations = 0;
            scene.solver.tolerance = 1e-9;
        }),
        member("last", 4, |_| {}),
    ]
}

/// Records, without the values that `history.csv` does not have, and failures in words, which are equal where every bit
/// is.
fn words(outcomes: &[Outcome]) -> Vec<String> {
    let in_words = |outcome: &Outcome| {
        let mut records = outcome.records.clone();
        for record in &mut records {
            record.report.strategy = None;
            record.report.residual_history.clear();
        }
        format!("{records:?} {:?}", outcome.failure)
    };
    outcomes.iter().map(in_words).collect()
}

#[test]
fn outcomes_do_not_depend_on_the_number_of_threads() {
    let members = members(2);
    let single = ensemble::run(&members, 1);
    assert_eq!(words(&ensemble::run(&members, 3)), words(&single));
    assert_eq!(words(&ensemble::run(&members, 0)), words(&single));
    let taken: Vec<usize> = single.iter().map(|outcome| outcome.records.len()).collect();
    assert_eq!(taken, [2, 0, 0, 2]);
    let failed: Vec<bool> = single.iter().map(|outcome| outcome.failure.is_some()).collect();
    assert_eq!(failed, [false, true, true, false]);
    assert!(ensemble::run(&[], 2).is_empty());
}

#[test]
fn stopped_ensemble_is_resumed() {
    let folder = tempfile::tempdir().unwrap();
    let (whole, parts) = (folder.path().join("whole"), folder.path().join("parts"));
    let expected = words(&ensemble::run_in(&whole, &members(4), 2, 1).unwrap());
    assert_eq!(expected, words(&ensemble::run(&members(4), 2)));
    // Only the first two members had been looked at, and those not to their end.
    ensemble::run_in(&parts, &members(2)[..2], 1, 1).unwrap();
    assert_eq!(words(&ensemble::run_in(&parts, &members(4), 2, 1).unwrap()), expected);
    // Once more: all is there.
    assert_eq!(words(&ensemble::run_in(&parts, &members(4), 2, 1).unwrap()), expected);
    for name in ["first/history.csv", "last/history.csv", "last/checkpoint", "first/fields.npz"] {
        assert_eq!(
            std::fs::read(whole.join(name)).unwrap(),
            std::fs::read(parts.join(name)).unwrap(),
            "{name}"
        );
    }
}

#[test]
fn names_must_be_those_of_folders() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["", ".", "..", "a/b", "last"] {
        let mut members = members(1);
        members[0].name = name.to_owned();
        let error = ensemble::run_in(folder.path(), &members, 1, 1).unwrap_err();
        assert!(error.to_string().contains(&format!("name \"{name}\"")), "{error}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}
