//! Parameters of random surfaces against the requested ones.

use approx::assert_relative_eq;
use stribeck::metrics::{AreaCorrelation, BearingCurve, height_statistics, radial_spectrum};
use stribeck::surface::{
    Autocorrelation, HeightDistribution, HeightScale, RandomShape, RandomSurface, SelfAffine, Synthesis,
};
use stribeck::{Boundary, Grid};

const RQ: f64 = 100e-9;

fn correlated(autocorrelation: Autocorrelation, length_x: f64, length_y: f64, seed: u64) -> RandomSurface {
    RandomSurface::new(RandomShape::Correlated { autocorrelation, length_x, length_y }, RQ, seed)
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

#[test]
fn gaussian_surfaces_have_the_parameters_of_the_normal_distribution() {
    let grid = Grid::centred(1024, 1024, 1e-6, 1e-6).unwrap();
    let mut found = [0.0; 7];
    for seed in 1..=5 {
        let heights = correlated(Autocorrelation::Gaussian, 10e-6, 10e-6, seed).generate(&grid).unwrap();
        let curve = BearingCurve::new(&heights).unwrap();
        let (core, volumes) = (curve.core(), curve.volumes(0.1, 0.8).unwrap());
        let values = [core.sk, core.spk, core.svk, volumes.vvv, volumes.vvc, volumes.vmp, volumes.vmc];
        found.iter_mut().zip(values).for_each(|(sum, value)| *sum += value / RQ / 5.0);
        // the length of 10 nodes is where a tenth is left
        let correlation = AreaCorrelation::new(&grid, &heights, None, Boundary::Periodic).unwrap();
        for lag in [(10, 0), (0, 10)] {
            let tenth = correlation.at(lag.0, lag.1).unwrap();
            assert!((tenth - 0.1).abs() < 0.03, "seed {seed}: {tenth}");
        }
    }
    for (found, expected) in found.iter().zip([2.574, 0.945, 0.945, 0.1116, 1.2173, 0.0473, 0.9059]) {
        assert_relative_eq!(*found, expected, max_relative = 0.015);
    }
}

#[test]
#[ignore = "slow"]
fn skewness_and_kurtosis_are_met_by_the_mean_over_seeds() {
    let grid = Grid::centred(512, 512, 1e-6, 1e-6).unwrap();
    let cases = [
        (Autocorrelation::Gaussian, -1.0, 5.0),
        (Autocorrelation::Exponential, -1.0, 5.0),
        (Autocorrelation::Gaussian, 0.8, 4.0),
        (Autocorrelation::Gaussian, 0.5, 2.2),
    ];
    for (kind, skewness, kurtosis) in cases {
        let (mut skews, mut kurtoses, mut tenths) = (Vec::new(), Vec::new(), Vec::new());
        for seed in 0..12 {
            let surface = (correlated(kind, 6e-6, 6e-6, seed))
                .with_distribution(HeightDistribution::Johnson { skewness, kurtosis });
            let heights = surface.generate(&grid).unwrap();
            let statistics = height_statistics(&heights).unwrap();
            assert_relative_eq!(statistics.sq, RQ, max_relative = 1e-12);
            skews.push(statistics.ssk);
            kurtoses.push(statistics.sku);
            let correlation = AreaCorrelation::new(&grid, &heights, None, Boundary::Periodic).unwrap();
            tenths.push(correlation.at(6, 0).unwrap());
        }
        assert_relative_eq!(mean(&skews), skewness, max_relative = 0.05);
        assert_relative_eq!(mean(&kurtoses), kurtosis, max_relative = 0.05);
        assert!((mean(&tenths) - 0.1).abs() < 0.03, "{kind:?}: {}", mean(&tenths));
    }
}

#[test]
fn pairs_of_moments_that_do_not_exist_are_refused_with_the_range() {
    let grid = Grid::centred(16, 16, 1e-6, 1e-6).unwrap();
    let generate = |skewness, kurtosis| {
        (correlated(Autocorrelation::Gaussian, 4e-6, 4e-6, 1))
            .with_distribution(HeightDistribution::Johnson { skewness, kurtosis })
            .generate(&grid)
    };
    let error = generate(-1.0, 1.9).unwrap_err().to_string();
    assert!(error.starts_with("kurtosis = 1.9") && error.contains("= 2.2000 and 100"), "{error}");
    for (skewness, kurtosis) in [
        (2.0, 5.0),
        (0.0, 1.0),
        (0.0, 101.0),
        (0.0, f64::NAN),
        (f64::NAN, 3.0),
        (6.0, 50.0),
        (f64::INFINITY, 3.0),
    ] {
        let error = generate(skewness, kurtosis).unwrap_err().to_string();
        assert!(error.starts_with("kurtosis") || error.starts_with("skewness"), "{error}");
    }
}

fn self_affine(hurst: f64, synthesis: Synthesis) -> SelfAffine {
    SelfAffine { hurst, longest: f64::INFINITY, roll_off: 64e-6, shortest: 4e-6, synthesis }
}

#[test]
fn self_affine_spectra_have_the_requested_cutoffs_and_slope() {
    let grid = Grid::centred(512, 512, 1e-6, 1e-6).unwrap();
    for (hurst, synthesis) in
        [(0.8, Synthesis::RandomPhase), (0.8, Synthesis::FilteredNoise), (0.3, Synthesis::RandomPhase)]
    {
        let shape = RandomShape::SelfAffine(self_affine(hurst, synthesis));
        let heights = RandomSurface::new(shape, RQ, 3).generate(&grid).unwrap();
        assert_relative_eq!(height_statistics(&heights).unwrap().sq, RQ, max_relative = 1e-12);
        let spectrum = radial_spectrum(&grid, &heights, Boundary::Periodic).unwrap();
        let (mut points, mut flat) = (Vec::new(), Vec::new());
        for (q, density) in spectrum.wavenumber.iter().zip(&spectrum.density) {
            let wavelength = std::f64::consts::TAU / q;
            if (5e-6..=50e-6).contains(&wavelength) {
                points.push((q.ln(), density.ln()));
            } else if wavelength > 80e-6 {
                flat.push(*density);
            } else if wavelength < 3.95e-6 {
                assert!(density / spectrum.density[0] < 1e-20, "{wavelength}: {density}");
            }
        }
        let centre = [
            mean(&points.iter().map(|p| p.0).collect::<Vec<_>>()),
            mean(&points.iter().map(|p| p.1).collect::<Vec<_>>()),
        ];
        let product: f64 = points.iter().map(|p| (p.0 - centre[0]) * (p.1 - centre[1])).sum();
        let square: f64 = points.iter().map(|p| (p.0 - centre[0]).powi(2)).sum();
        assert!((product / square + 2.0 * (1.0 + hurst)).abs() < 0.1, "{hurst}: {}", product / square);
        if synthesis == Synthesis::RandomPhase {
            assert!(flat.iter().all(|density| (density / flat[0] - 1.0).abs() < 1e-9));
        }
    }
    let bad = [
        SelfAffine { hurst: 0.0, ..self_affine(0.8, Synthesis::RandomPhase) },
        SelfAffine { hurst: 1.1, ..self_affine(0.8, Synthesis::RandomPhase) },
        SelfAffine { roll_off: 3e-6, ..self_affine(0.8, Synthesis::RandomPhase) },
        SelfAffine { longest: 32e-6, ..self_affine(0.8, Synthesis::RandomPhase) },
        SelfAffine { shortest: f64::NAN, ..self_affine(0.8, Synthesis::RandomPhase) },
        SelfAffine { longest: 1.0, roll_off: 0.9, shortest: 0.5, ..self_affine(0.8, Synthesis::RandomPhase) },
    ];
    for shape in bad {
        let surface = RandomSurface::new(RandomShape::SelfAffine(shape), RQ, 3);
        let error = surface.generate(&grid).unwrap_err().to_string();
        assert!(error.starts_with("roughness."), "{error}");
    }
}

#[test]
fn ensemble_heights_scatter_about_the_requested_rq() {
    let grid = Grid::centred(64, 64, 1e-6, 1e-6).unwrap();
    let johnson = HeightDistribution::Johnson { skewness: -0.5, kurtosis: 4.0 };
    for distribution in [HeightDistribution::Normal, johnson] {
        for boundary in [Boundary::Periodic, Boundary::Open] {
            let squares: Vec<f64> = (0..200)
                .map(|seed| {
                    let surface = (correlated(Autocorrelation::Gaussian, 8e-6, 8e-6, seed))
                        .with_height(HeightScale::Ensemble)
                        .with_distribution(distribution)
                        .with_boundary(boundary);
                    let heights = surface.generate(&grid).unwrap();
                    mean(&heights.iter().map(|z| z * z).collect::<Vec<_>>()) / (RQ * RQ)
                })
                .collect();
            let scatter = squares.iter().fold(0.0_f64, |most, s| most.max((s - 1.0).abs()));
            // single surfaces differ by some 10 %, their mean by 1 %
            assert!(
                (mean(&squares) - 1.0).abs() < 0.035,
                "{distribution:?} {boundary:?}: {}",
                mean(&squares)
            );
            assert!(scatter > 0.1, "{scatter}");
        }
    }
}

#[test]
fn edges_of_open_surfaces_do_not_fit_together() {
    let grid = Grid::centred(128, 96, 1e-6, 1e-6).unwrap();
    let shapes = [
        correlated(Autocorrelation::Gaussian, 12e-6, 12e-6, 5),
        RandomSurface::new(RandomShape::SelfAffine(self_affine(0.9, Synthesis::FilteredNoise)), RQ, 5),
    ];
    for shape in shapes {
        let jump = |boundary| {
            let heights = shape.with_boundary(boundary).generate(&grid).unwrap();
            assert_relative_eq!(height_statistics(&heights).unwrap().sq, RQ, max_relative = 1e-12);
            let square = |i: usize, k: usize| {
                mean(
                    &(0..96)
                        .map(|j| (heights[j * 128 + i] - heights[j * 128 + k]).powi(2))
                        .collect::<Vec<_>>(),
                )
            };
            square(0, 127).sqrt() / square(60, 61).sqrt()
        };
        assert!(jump(Boundary::Periodic) < 2.0, "{}", jump(Boundary::Periodic));
        assert!(jump(Boundary::Open) > 3.0, "{}", jump(Boundary::Open));
    }
    let lone = Grid::centred(64, 1, 1e-6, 1e-6).unwrap();
    let line = (correlated(Autocorrelation::Gaussian, 8e-6, 1e-6, 2)).with_boundary(Boundary::Open);
    assert_eq!(line.generate(&lone).unwrap().len(), 64);
}

#[test]
fn open_surfaces_of_a_few_nodes_are_made_or_refused() {
    for (nx, ny) in [(1, 1), (2, 1), (1, 2), (2, 2), (3, 1), (1, 5), (3, 7)] {
        let grid = Grid::centred(nx, ny, 1e-6, 1e-6).unwrap();
        let fractal = RandomShape::SelfAffine(self_affine(0.8, Synthesis::RandomPhase));
        let coarse = RandomShape::SelfAffine(SelfAffine {
            roll_off: 5e-3,
            ..self_affine(0.8, Synthesis::FilteredNoise)
        });
        let kinds = [
            correlated(Autocorrelation::Gaussian, 1e-6, 1e-6, 1),
            correlated(Autocorrelation::Exponential, 1e-9, 1e-6, 1),
            RandomSurface::new(fractal, RQ, 1),
            RandomSurface::new(coarse, RQ, 1),
        ];
        for kind in kinds {
            match (kind.with_boundary(Boundary::Open)).generate(&grid) {
                Ok(heights) => {
                    assert_eq!(heights.len(), nx * ny);
                    let square = mean(&heights.iter().map(|z| z * z).collect::<Vec<_>>());
                    assert_relative_eq!(square.sqrt(), RQ, max_relative = 1e-9);
                }
                Err(error) => assert!(
                    nx * ny == 1 && error.to_string().contains("too few nodes"),
                    "{nx} x {ny} {kind:?}: {error}"
                ),
            }
        }
    }
    // no wave is left but the constant one
    let long = SelfAffine { roll_off: 1e-3, shortest: 0.9e-3, ..self_affine(0.8, Synthesis::FilteredNoise) };
    let kind = (RandomSurface::new(RandomShape::SelfAffine(long), RQ, 1)).with_boundary(Boundary::Open);
    let error = kind.generate(&Grid::centred(64, 48, 1e-6, 1e-6).unwrap()).unwrap_err().to_string();
    assert!(error.contains("too few nodes"), "{error}");
}

#[test]
fn open_surfaces_are_the_same_at_their_edges_as_in_their_middle() {
    let (nx, ny) = (48, 40);
    let grid = Grid::centred(nx, ny, 1e-6, 1e-6).unwrap();
    let roll_off = 48e-6;
    let phases = SelfAffine { roll_off, ..self_affine(0.8, Synthesis::RandomPhase) };
    let noise = SelfAffine { synthesis: Synthesis::FilteredNoise, ..phases };
    // of an endless surface at a lag of 12 nodes: 10^-1 at the length, and by the integral of the spectrum
    // with its cut-off
    let kinds = [
        (correlated(Autocorrelation::Gaussian, 12e-6, 12e-6, 0), 0.1),
        (correlated(Autocorrelation::Exponential, 12e-6, 12e-6, 0), 0.1),
        (RandomSurface::new(RandomShape::SelfAffine(noise), RQ, 0), endless(&noise, 12e-6)),
        (RandomSurface::new(RandomShape::SelfAffine(phases), RQ, 0), endless(&phases, 12e-6)),
    ];
    for (kind, expected) in kinds {
        let seeds = 3000_u32;
        // along x at the left, in the middle, at the right; along y at the lower and upper edge; between left
        // and right edge
        let pairs = [
            [(0, 20), (12, 20)],
            [(18, 20), (30, 20)],
            [(35, 3), (47, 3)],
            [(24, 0), (24, 12)],
            [(9, 27), (9, 39)],
            [(0, 11), (47, 11)],
        ];
        let (mut products, mut squares) = ([0.0; 6], [0.0; 2]);
        for seed in 0..seeds {
            let (height, boundary) = (HeightScale::Ensemble, Boundary::Open);
            let heights = kind
                .with_seed(seed.into())
                .with_height(height)
                .with_boundary(boundary)
                .generate(&grid)
                .unwrap();
            let at = |(i, j): (usize, usize)| heights[j * nx + i] / RQ;
            products.iter_mut().zip(pairs).for_each(|(sum, [a, b])| *sum += at(a) * at(b) / f64::from(seeds));
            squares
                .iter_mut()
                .zip([(0, 0), (24, 20)])
                .for_each(|(sum, k)| *sum += at(k).powi(2) / f64::from(seeds));
        }
        // four standard errors of a mean of products of normal deviates
        let slack = 4.0 / (f64::from(seeds)).sqrt();
        for product in &products[..5] {
            assert!(
                (product - expected).abs() < slack * (1.0 + expected * expected).sqrt(),
                "{kind:?}: {products:?}, not {expected}"
            );
        }
        assert!(products[5].abs() < 0.06 + slack, "{kind:?}: {products:?}");
        assert!(
            squares.iter().all(|square| (square - 1.0).abs() < slack * 2.0_f64.sqrt()),
            "{kind:?}: {squares:?}"
        );
    }
}

/// Autocorrelation of an endless self-affine surface, summed over rings and angles of wave numbers.
fn endless(spectrum: &SelfAffine, lag: f64) -> f64 {
    let (mut sum, mut variance) = (0.0, 0.0);
    let count = 4000;
    let highest = 1.0 / spectrum.shortest;
    for k in 0..count {
        let frequency = (f64::from(k) + 0.5) / f64::from(count) * highest;
        let density = (frequency * spectrum.roll_off).max(1.0).powf(-2.0 * (1.0 + spectrum.hurst));
        let angles = (0..180).map(|a| (f64::from(a) * std::f64::consts::TAU / 180.0).cos());
        let bessel = mean(
            &angles.map(|cos| (std::f64::consts::TAU * frequency * lag * cos).cos()).collect::<Vec<_>>(),
        );
        sum += frequency * density * bessel;
        variance += frequency * density;
    }
    sum / variance
}

#[test]
fn every_kind_is_pinned_by_its_seed() {
    let grid = Grid::centred(48, 40, 1e-6, 1e-6).unwrap();
    let skewed = HeightDistribution::Johnson { skewness: -1.0, kurtosis: 5.0 };
    let fractal =
        RandomShape::SelfAffine(SelfAffine { roll_off: 20e-6, ..self_affine(0.8, Synthesis::RandomPhase) });
    let kinds = [
        (correlated(Autocorrelation::Exponential, 8e-6, 5e-6, 9)).with_distribution(skewed),
        (correlated(Autocorrelation::Gaussian, 8e-6, 5e-6, 9)).with_boundary(Boundary::Open),
        RandomSurface::new(fractal, RQ, 9),
        (RandomSurface::new(fractal, RQ, 9)).with_boundary(Boundary::Open),
    ];
    let found = kinds.map(|kind| {
        let heights = kind.generate(&grid).unwrap();
        assert_eq!(heights, kind.generate(&grid).unwrap());
        [0, 1, 48, 1919].map(|k| heights[k])
    });
    let pairs = found.iter().flatten().zip(RECORDED.iter().flatten());
    let close = pairs.into_iter().all(|(z, value)| (z - value).abs() < 2e-9 * RQ);
    assert!(close, "{found:?} instead of {RECORDED:?}");
}

/// Of three times as many cells every third node is one of those on which the heights are drawn.
#[test]
fn given_cells_have_one_surface_on_all_meshes() {
    let box_of = |nx: usize, ny: usize| Grid::from_edges(nx, ny, [-3e-5, 6.6e-5], [-4e-5, 4e-5]).unwrap();
    let skewed = HeightDistribution::Johnson { skewness: -1.0, kurtosis: 5.0 };
    let fractal = RandomShape::SelfAffine(self_affine(0.8, Synthesis::FilteredNoise));
    for drawn in [
        correlated(Autocorrelation::Gaussian, 16e-6, 12e-6, 9),
        correlated(Autocorrelation::Exponential, 16e-6, 12e-6, 9).with_distribution(skewed),
        RandomSurface::new(fractal, RQ, 9),
    ] {
        let coarse = drawn.generate(&box_of(48, 40)).unwrap();
        let surface = drawn.with_cells(Some([48, 40]));
        assert_eq!(surface.generate(&box_of(48, 40)).unwrap(), coarse);
        let fine = surface.generate(&box_of(144, 120)).unwrap();
        let statistics = height_statistics(&fine).unwrap();
        // Waves of two cells keep half of their mean square between the nodes.
        assert!((statistics.sq / RQ - 1.0).abs() < 1e-2, "{}", statistics.sq);
        for (k, height) in coarse.iter().enumerate() {
            let same = fine[(3 * (k / 48) + 1) * 144 + 3 * (k % 48) + 1];
            assert!((height - same).abs() < 1e-12 * RQ, "{k}: {height:e} {same:e}");
        }
        // Fewer cells sample the same heights.
        let few = surface.generate(&box_of(16, 8)).unwrap();
        for (k, height) in few.iter().enumerate() {
            let same = coarse[(5 * (k / 16) + 2) * 48 + 3 * (k % 16) + 1];
            assert!((height - same).abs() < 1e-12 * RQ, "{k}: {height:e} {same:e}");
        }
    }
}

#[test]
fn cells_of_a_surface_that_do_not_suit_are_refused() {
    let surface = correlated(Autocorrelation::Gaussian, 16e-6, 12e-6, 9);
    let area = Grid::centred(48, 40, 1e-6, 1e-6).unwrap();
    let row = Grid::centred(48, 1, 1e-6, 1.0).unwrap();
    let ridges = surface.with_cells(Some([24, 1]));
    assert_eq!(ridges.generate(&row).unwrap().len(), 48);
    for (surface, grid, reason) in [
        (ridges, area, "one row"),
        (surface.with_cells(Some([24, 20])), row, "one row"),
        (surface.with_cells(Some([0, 20])), area, "at least 2"),
        (surface.with_cells(Some([24, 0])), area, "at least 1"),
        (surface.with_cells(Some([1 << 20, 1 << 20])), area, "at most"),
        (surface.with_cells(Some([24, 20])).with_boundary(Boundary::Open), area, "periodic"),
    ] {
        let error = surface.generate(&grid).unwrap_err().to_string();
        assert!(error.contains("roughness.cells = [") && error.contains(reason), "{error}");
    }
}

#[test]
fn threads_change_no_bit() {
    let grid = Grid::centred(256, 250, 1e-6, 1e-6).unwrap();
    let skewed = HeightDistribution::Johnson { skewness: -1.0, kurtosis: 5.0 };
    let fractal = RandomShape::SelfAffine(self_affine(0.8, Synthesis::RandomPhase));
    let kinds = [
        (correlated(Autocorrelation::Exponential, 8e-6, 5e-6, 9)).with_distribution(skewed),
        (correlated(Autocorrelation::Gaussian, 8e-6, 5e-6, 9)).with_boundary(Boundary::Open),
        RandomSurface::new(fractal, RQ, 9),
    ];
    for kind in kinds {
        let [one, three] = [1, 3].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| kind.generate(&grid).unwrap())
        });
        assert_eq!(one, three, "{kind:?}");
    }
}

/// Points 0, 1, 48 and 1919 of each kind as recorded. Transforms without vector units differ by at most 4e-10
/// of Rq.
const RECORDED: [[f64; 4]; 4] = [
    [
        4.554_922_164_241_156e-8,
        1.831_900_020_122_596_8e-8,
        -2.187_977_521_883_687e-8,
        5.160_201_380_470_997_5e-8,
    ],
    [
        2.000_324_909_937_216_7e-7,
        1.986_929_300_742_988_5e-7,
        1.815_907_490_014_398e-7,
        -5.334_249_965_292_62e-9,
    ],
    [
        -8.245_495_006_917_577e-8,
        -1.036_647_570_689_508_6e-7,
        -4.975_847_857_092_531e-8,
        -9.304_314_248_403_856e-8,
    ],
    [
        1.090_891_035_676_560_5e-8,
        2.096_147_278_705_504_4e-8,
        1.579_418_511_155_187_2e-8,
        -5.011_386_226_515_490_6e-8,
    ],
];
