//! Oils by grade, kinematic viscosities, density and viscosity index, beside published oils.

use stribeck::lubricant::{
    BaseOil, Oil, PressureViscosity, ViscosityLaw, Walther, petroleum_density, so_klaus, viscosity_index,
};
use stribeck::sim::scene::{KinematicPoint, LubricantSpec, OilSpec};
use stribeck::sim::{MixedLubricationSim, Scene, Schedule, solve_contact};
use stribeck::testing;

/// Zero of the Celsius scale \[K\].
const CELSIUS: f64 = 273.15;

/// Reference viscosities of ASTM D2270, table 1: at 100 degrees, L and H \[cSt\].
const REFERENCE: [[f64; 3]; 8] = [
    [2.0, 7.994, 6.394],
    [2.9, 14.63, 11.5],
    [4.0, 25.32, 19.56],
    [5.0, 40.23, 28.49],
    [6.2, 61.52, 40.15],
    [7.5, 88.85, 53.98],
    [10.0, 147.7, 82.87],
    [13.4, 244.3, 127.0],
];

#[test]
fn reference_oils_have_the_indices_0_and_100() {
    for [at_100, low, high] in REFERENCE {
        let index = |at_40: f64| viscosity_index(1e-6 * at_40, 1e-6 * at_100).unwrap();
        // The equations of the standard fit its table to 0.12 %.
        assert!(index(low).abs() < 0.4, "{at_100}: {}", index(low));
        assert!((index(high) - 100.0).abs() < 0.4, "{at_100}: {}", index(high));
    }
    for (at_40, at_100) in [(0.0, 5e-6), (f64::NAN, 5e-6), (46e-6, 1.9e-6), (46e-6, f64::INFINITY)] {
        assert!(viscosity_index(at_40, at_100).is_err(), "{at_40} {at_100}");
    }
}

#[test]
fn walther_passes_through_both_points_and_falls() {
    let points = [[67e-6, 40.0 + CELSIUS], [8.9e-6, 100.0 + CELSIUS]];
    let oil = Walther::new(points).unwrap();
    for [viscosity, temperature] in points {
        assert!((oil.kinematic_viscosity(temperature) / viscosity - 1.0).abs() < 1e-10);
    }
    assert_eq!(Walther::new([points[1], points[0]]).unwrap().slope().to_bits(), oil.slope().to_bits());
    let viscosities: Vec<f64> = (1..300).map(|k| oil.kinematic_viscosity(10.0 * f64::from(k))).collect();
    assert!(viscosities.iter().all(|viscosity| viscosity.is_finite() && *viscosity > 0.0));
    assert!(viscosities.windows(2).all(|pair| pair[1] <= pair[0]));
}

/// Gear oils of five grades: viscosity at 100 degrees \[cSt\] and index of the data sheet of Mobilgear 600 XP.
#[test]
fn grade_and_index_give_the_viscosity_at_100_degrees() {
    for (grade, at_100, index) in
        [(68, 8.8, 101.0), (100, 11.2, 97.0), (150, 14.7, 97.0), (220, 19.0, 97.0), (460, 30.6, 96.0)]
    {
        let [_, hot] = OilSpec::iso_vg(grade, index).walther().unwrap().index_viscosities();
        assert!((1e6 * hot / at_100 - 1.0).abs() < 0.006, "{grade}: {hot:e}");
        let found = viscosity_index(1e-6 * f64::from(grade), 1e-6 * at_100).unwrap();
        assert!((found - index).abs() < 1.0, "{grade}: {found}");
    }
    for index in [-50.0, 0.0, 60.0, 99.9, 100.1, 140.0, 250.0] {
        let oil = OilSpec::iso_vg(100, index).walther().unwrap();
        assert!((oil.viscosity_index().unwrap() - index).abs() < 0.5, "{index}");
    }
}

/// Viscosity \[mPa s\] and pressure-viscosity coefficient \[1/GPa\] at 30, 60 and 100 degrees Celsius, and an assumed
/// density at 15 degrees \[kg/m^3\], of 13 mineral oils: Stachowiak and Batchelor, Engineering Tribology, table 2.3.
const MINERAL: [([f64; 3], [Option<f64>; 3], f64); 13] = [
    ([38.0, 12.1, 5.3], [None, Some(18.4), Some(13.4)], 870.0),
    ([153.0, 34.0, 9.1], [Some(23.7), Some(20.5), Some(15.8)], 870.0),
    ([250.0, 50.5, 12.6], [Some(25.0), Some(21.3), Some(17.6)], 870.0),
    ([810.0, 135.0, 26.8], [Some(34.0), Some(28.0), Some(22.0)], 870.0),
    ([18.6, 6.3, 2.4], [Some(20.0), Some(16.0), Some(13.0)], 885.0),
    ([45.0, 12.0, 3.9], [Some(28.0), Some(20.0), Some(16.0)], 885.0),
    ([107.0, 23.3, 6.4], [Some(29.6), Some(22.8), Some(17.8)], 885.0),
    ([122.0, 26.3, 7.3], [Some(27.0), Some(21.6), Some(17.5)], 885.0),
    ([171.0, 31.0, 7.5], [Some(28.0), Some(23.0), Some(18.0)], 885.0),
    ([30.7, 8.6, 3.1], [Some(25.7), Some(20.3), Some(15.4)], 910.0),
    ([165.0, 30.0, 6.8], [Some(33.0), Some(23.8), Some(16.0)], 910.0),
    ([310.0, 44.2, 9.4], [Some(34.6), Some(26.3), Some(19.5)], 910.0),
    ([2000.0, 180.0, 24.0], [Some(41.5), Some(29.4), Some(25.0)], 910.0),
];

#[test]
fn so_klaus_is_within_its_scatter_of_published_mineral_oils() {
    let temperatures = [30.0, 60.0, 100.0].map(|celsius| celsius + CELSIUS);
    let mut deviations = Vec::new();
    for (viscosities, measured, density) in MINERAL {
        let at = |k: usize| {
            let density = petroleum_density(density, temperatures[k]);
            (1e-3 * viscosities[k] / density, density)
        };
        let oil = Walther::new([[at(0).0, temperatures[0]], [at(2).0, temperatures[2]]]).unwrap();
        // The viscosity between both points is published too.
        assert!((oil.kinematic_viscosity(temperatures[1]) / at(1).0 - 1.0).abs() < 0.17);
        for (k, measured) in measured.into_iter().enumerate() {
            let Some(measured) = measured else { continue };
            let (viscosity, density) = at(k);
            deviations.push(1e9 * so_klaus(viscosity, density, oil.slope()) / measured - 1.0);
        }
    }
    let n = deviations.len() as f64;
    let mean = deviations.iter().sum::<f64>() / n;
    let rms = (deviations.iter().map(|deviation| deviation * deviation).sum::<f64>() / n).sqrt();
    assert_eq!(deviations.len(), 38);
    assert!((0.08..0.12).contains(&mean), "{mean}");
    assert!((0.13..1.1 * BaseOil::Mineral.uncertainty()).contains(&rms), "{rms}");
}

/// Synthetic paraffinic oil and ester at 38 and 99 degrees Celsius: Jones, Johnson, Winer and Sanborn 1975.
#[test]
fn synthetic_oils_are_within_their_scatter_of_published_ones() {
    for (base, viscosities, measured, density) in [
        (BaseOil::Polyalphaolefin, [414.0, 34.3], [17.7, 15.1], 850.0),
        (BaseOil::Ester, [25.3, 4.75], [12.8, 9.87], 970.0),
    ] {
        for ((viscosity, measured), celsius) in viscosities.into_iter().zip(measured).zip([38.0, 99.0]) {
            let density = petroleum_density(density, celsius + CELSIUS);
            let found = 1e9 * base.alpha(1e-3 * viscosity / density, density, 3.0);
            assert!((found / measured - 1.0).abs() < base.uncertainty(), "{base}: {found} {measured}");
        }
    }
}

#[test]
fn density_falls_by_the_tables_of_lubricating_oils() {
    assert!((petroleum_density(870.0, 288.15) - 870.0).abs() < 1e-12);
    // 0.6278/870 per kelvin near 15 degrees.
    let slope = petroleum_density(870.0, 288.65) - petroleum_density(870.0, 287.65);
    assert!((slope + 0.6278).abs() < 1e-3, "{slope}");
}

#[test]
fn oils_fulfil_the_contract_of_viscosity_laws() {
    let pressures = [0.0, 1e8, 5e8, 1e9, 3e9];
    for (points, base) in [
        ([67e-6, 8.9e-6], BaseOil::Mineral),
        ([10e-6, 2.5e-6], BaseOil::Mineral),
        ([1000e-6, 60e-6], BaseOil::Mineral),
        ([400e-6, 40e-6], BaseOil::Polyalphaolefin),
        ([27e-6, 5.2e-6], BaseOil::Ester),
    ] {
        let [warm, hot] = points;
        let oil = Walther::new([[warm, 40.0 + CELSIUS], [hot, 100.0 + CELSIUS]]).unwrap();
        let correlation = PressureViscosity::Correlation(base);
        let measured = PressureViscosity::Measured { alpha: 20e-9, temperature: 313.15 };
        for pressure in [correlation, measured] {
            let law = Oil::new(oil, 870.0, pressure, 353.15).unwrap();
            testing::viscosity_law(&law).unwrap();
            for p in pressures {
                let viscosities: Vec<f64> =
                    (0..70).map(|k| law.viscosity_at(p, 250.0 + 10.0 * f64::from(k)).unwrap()).collect();
                assert!(viscosities.iter().all(|viscosity| viscosity.is_finite() && *viscosity > 0.0));
                let rises = viscosities.windows(2).position(|pair| pair[1] > pair[0] * (1.0 + 1e-12));
                assert!(rises.is_none(), "{base} {p:e} {rises:?} {viscosities:?}");
            }
        }
    }
}

fn scene(lubricant: &str) -> String {
    format!(
        "[form]\nkind = \"sphere\"\nradius = \"10 mm\"\n[elastic]\nequivalent_modulus = \"230 GPa\"\n[load]\n\
         hertz_pressure = \"0.6 GPa\"\n[motion]\nentrainment_speed = \"0.5 m/s\"\n[thermal]\nbulk_temperature = \"60 degC\"\n\
         [grid]\nnx = 48\nny = 48\nx = [\"-250 um\", \"250 um\"]\ny = [\"-250 um\", \"250 um\"]\n[lubricant]\n{lubricant}"
    )
}

#[test]
fn contact_has_the_film_of_its_viscosity_and_coefficient() {
    let sheet = "kinematic = \"67 cSt at 40 degC, 8.9 cSt at 100 degC\"\ndensity = \"0.87 g/cm3\"\n";
    let stated = Scene::from_toml(&scene(sheet)).unwrap();
    let oil = stated.oil_numbers().unwrap().unwrap();
    let walther = Walther::new([[67e-6, 313.15], [8.9e-6, 373.15]]).unwrap();
    let density = petroleum_density(870.0, 333.15);
    let viscosity = walther.kinematic_viscosity(333.15);
    assert!((oil.eta0 / (density * viscosity) - 1.0).abs() < 1e-12);
    assert!((oil.alpha / so_klaus(viscosity, density, walther.slope()) - 1.0).abs() < 1e-12);
    let mut same = stated.clone();
    let z = oil.alpha * 1.96e8 / (oil.eta0.ln() + 9.67);
    same.lubricant = Some(LubricantSpec::roelands(oil.eta0, z));
    let [stated, same] = [stated, same].map(|scene| solve_contact(&scene).unwrap().film.central);
    assert!((stated / same - 1.0).abs() < 1e-9);
    let given = Scene::from_toml(&scene(&format!("{sheet}alpha = \"20 1/GPa\"\n"))).unwrap();
    let given = given.oil_numbers().unwrap().unwrap();
    assert!((given.alpha / 20e-9 - 1.0).abs() < 1e-12 && given.film_uncertainty == 0.0);
}

/// A scheduled bulk temperature has the oil of a scene at that temperature.
#[test]
fn oil_of_a_history_follows_the_bulk_temperature() {
    let mut scene = Scene::from_toml(&scene("grade = \"ISO VG 68\"\nviscosity_index = 98\n")).unwrap();
    let mut film_at = |temperature: f64| {
        scene.schedule.bulk_temperature = Some(Schedule::Constant { value: temperature });
        let mut sim = MixedLubricationSim::builder(scene.clone()).build().unwrap();
        let scheduled = sim.step(1.0).unwrap().film.mean_central;
        scene.schedule.bulk_temperature = None;
        scene.thermal.bulk_temperature = temperature;
        let own = solve_contact(&scene).unwrap().film.mean_central;
        scene.thermal.bulk_temperature = 333.15;
        assert!((scheduled / own - 1.0).abs() < 1e-6, "{scheduled} {own}");
        own
    };
    assert!(film_at(313.15) > 2.0 * film_at(353.15));
}

#[test]
fn scene_files_keep_the_statement_of_the_oil() {
    for lubricant in [
        "grade = \"ISO VG 46\"\nviscosity_index = 95\n",
        "grade = \"vg46\"\nkinematic = \"47 cSt at 40 degC, 7 mm^2/s at 100 degC\"\nbase_oil = \"pao\"\n",
        "kinematic = \"67 cSt at 40 degC, 8.9 cSt at 100 degC\"\ndensity = \"0.87 g/cm3\"\nalpha = \"20 1/GPa\"\n",
        "kinematic = \"8.9 cSt at 100 degC\"\nviscosity_index = 108.0\ndensity = 870.0\n",
    ] {
        let scene = Scene::from_toml(&scene(lubricant)).unwrap();
        assert_eq!(Scene::from_toml(&scene.to_toml().unwrap()).unwrap(), scene, "{lubricant}");
        assert!(scene.warnings().is_empty(), "{:?}", scene.warnings());
        assert!(scene.formula_film().unwrap().unwrap().central > 1e-8);
    }
    let spec = OilSpec::measured([KinematicPoint::new(67e-6, 313.15), KinematicPoint::new(8.9e-6, 373.15)]);
    let text = "kinematic = \"67 cSt at 40 degC, 8.9 cSt at 100 degC\"\n";
    assert_eq!(Scene::from_toml(&scene(text)).unwrap().lubricant, Some(LubricantSpec::of_oil(spec)));
}

#[test]
fn wrong_statements_are_refused_with_a_remedy() {
    let refused = |lubricant: &str| match Scene::from_toml(&scene(lubricant)) {
        Err(error) => error.to_string(),
        Ok(scene) => solve_contact(&scene).map(|_| ()).unwrap_err().to_string(),
    };
    let two = "kinematic = \"67 cSt at 40 degC, 8.9 cSt at 100 degC\"\n";
    let cases: [(&str, &[&str]); 20] = [
        ("kinematic = \"8.9 cSt at 40 degC, 67 cSt at 100 degC\"\n", &["lubricant.kinematic", "exchanged"]),
        ("kinematic = \"67 cSt at 40 degC, 67 cSt at 100 degC\"\n", &["lubricant.kinematic", "must fall"]),
        (
            "kinematic = \"67 cSt at 40 degC, 8.9 cSt at 40 degC\"\n",
            &["lubricant.kinematic", "two temperatures"],
        ),
        (&format!("{two}viscosity_index = 150\n"), &["lubricant.viscosity_index = 150", "106"]),
        (&format!("{two}grade = \"ISO VG 46\"\n"), &["lubricant.grade", "67", "41.4"]),
        ("grade = \"ISO VG 48\"\nviscosity_index = 95\n", &["lubricant.grade", "ISO VG 46, ISO VG 68"]),
        ("grade = \"ISO VG 9999\"\nviscosity_index = 95\n", &["lubricant.grade", "ISO VG 3200"]),
        ("grade = \"SAE 30\"\nviscosity_index = 95\n", &["lubricant.grade", "SAE", "lubricant.kinematic"]),
        ("grade = \"ISO VG 46\"\n", &["lubricant.viscosity_index", "about 95"]),
        ("kinematic = \"67 cSt at 40 degC\"\n", &["lubricant.viscosity_index", "missing"]),
        ("viscosity_index = 95\n", &["lubricant.kinematic", "lubricant.grade"]),
        ("grade = \"ISO VG 46\"\nviscosity_index = 9000\n", &["viscosity_index = 9000", "two"]),
        ("kinematic = \"67 at 40\"\n", &["lubricant.kinematic", "unit", "cSt"]),
        ("kinematic = \"67 cSt\"\n", &["lubricant.kinematic", "67 cSt at 40 degC"]),
        ("kinematic = \"67 mPa s at 40 degC, 8 mPa s at 100 degC\"\n", &["lubricant.kinematic", "`mPa s`"]),
        (
            "kinematic = \"6,7 cSt at 40 degC\"\nviscosity_index = 95\n",
            &["lubricant.kinematic", "decimal point"],
        ),
        (&format!("{two}density = 0.87\n"), &["lubricant.density = 0.87", "870 kg/m^3"]),
        (&format!("{two}eta0 = 0.04\n"), &["`eta0`", "kinematic"]),
        (&format!("{two}temperature = 313.15\n"), &["lubricant.temperature", "thermal.bulk_temperature"]),
        (
            &format!("{two}[lubricant.viscosity]\nlaw = \"barus\"\neta0 = 0.04\nalpha = 2e-8\n"),
            &["`kinematic`", "viscosity"],
        ),
    ];
    for (lubricant, parts) in cases {
        let error = refused(lubricant);
        assert!(parts.iter().all(|part| error.contains(part)), "{lubricant}{parts:?}: {error}");
        assert!(!error.contains('\n'), "{error}");
    }
}
