//! Growth laws compared over measured films: the true law is found, and failures are rows.

use stribeck::SurfaceState;
use stribeck::benchmark::growth::{GrowthLaw, compare, laws};
use stribeck::tribochem::{FilmGrowthLaw, MeasuredFilm, ProportionalRemoval, StressActivated};

/// Films by `law` at two temperatures and two stresses, rounded to 0.1 nm, as CSV.
fn table(law: &dyn FilmGrowthLaw) -> String {
    let mut table = String::from("time_s,temperature_k,stress_pa,thickness_m\n");
    for temperature in [353.15, 373.15] {
        for stress in [2e8, 6e8] {
            let at = SurfaceState::new(stress, temperature)
                .with_solid_pressure(stress)
                .with_shear_stress(stress)
                .with_sliding_speed(0.1)
                .with_in_contact(true);
            for k in 1..=25 {
                let mut states = vec![0.0; law.n_states()];
                law.advance(&at, 120.0 * f64::from(k), &mut states);
                let film = 1e9 * law.thickness(&states);
                table += &format!("{},{temperature},{stress:e},{film:.1}e-9\n", 120 * k);
            }
        }
    }
    table
}

#[test]
fn true_laws_have_the_smallest_criterion() {
    let activated = StressActivated::by_shear_stress(90e-9, 1.5e8, 1.28e-19, 8e-30).unwrap();
    let removed = ProportionalRemoval::new(400e-9, 12.0, 1.28e-19, 8e-30, 1.5e-3).unwrap();
    let cases: [(&dyn FilmGrowthLaw, &str); 2] =
        [(&activated, "stress_activated"), (&removed, "proportional_removal")];
    for (law, name) in cases {
        let films = MeasuredFilm::from_csv(table(law).as_bytes()).unwrap();
        assert_eq!(films.len(), 4);
        let comparison = compare(&films, laws(&films));
        assert_eq!(comparison.rows().len(), 6);
        let best = &comparison.rows()[0];
        assert!(best.law.starts_with(name), "{}", comparison.summary());
        assert!(best.standard_deviation < 1e-10, "{}", comparison.summary());
        assert!(comparison.to_csv().lines().count() == 7 && comparison.svg().starts_with("<svg"));
    }
}

#[test]
fn laws_that_fail_are_rows_with_reasons() {
    let law = StressActivated::by_shear_stress(90e-9, 1.5e8, 1.28e-19, 8e-30).unwrap();
    let films = MeasuredFilm::from_csv(table(&law).as_bytes()).unwrap();
    let panics = GrowthLaw::new("panics", [("h", 1e-7)], |_| panic!("a deliberate panic"));
    let useless = GrowthLaw::new("useless", [("h", 1e-7), ("nothing", 1.0)], |c| {
        Ok(Box::new(StressActivated::by_shear_stress(c[0], 1e-3, 0.0, 0.0)?))
    });
    let invalid = GrowthLaw::new("invalid", [("h", -1.0)], |c| {
        Ok(Box::new(StressActivated::by_shear_stress(c[0], 1e-3, 0.0, 0.0)?))
    });
    let comparison = compare(&films, [panics, useless, invalid]);
    let reason = |name: &str| {
        let row = comparison.rows().iter().find(|row| row.law == name).unwrap();
        assert!(row.aicc.is_nan() && row.constants.is_empty());
        row.reason.clone()
    };
    assert!(reason("panics").contains("panicked"));
    assert!(reason("useless").contains("nothing"), "{}", reason("useless"));
    assert!(reason("invalid").contains('h'), "{}", reason("invalid"));
}

#[test]
fn invalid_tables_are_rejected_with_their_line() {
    let error = |text: &str| MeasuredFilm::from_csv(text.as_bytes()).unwrap_err().to_string();
    assert!(error("60,353,2e8,1e-8\n120,353,2e8\n").starts_with("line 2"));
    assert!(error("60,353,2e8,1e-8\n120,cold,2e8,1e-8\n").contains("cold"));
    assert!(error("60,-3,2e8,1e-8\n").starts_with("temperature = -3"));
    assert!(error("60,353,0,1e-8\n").starts_with("stress = 0"));
    assert!(MeasuredFilm::from_csv("".as_bytes()).is_err());
    let five = MeasuredFilm::from_csv("60,353,2e8,1e-8,1e9\n".as_bytes()).unwrap();
    assert_eq!((five[0].conditions()[0].pressure, five[0].conditions()[0].shear_stress), (1e9, 2e8));
}
