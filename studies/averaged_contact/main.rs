//! Share of the load on solids in concentrated contacts: Greenwood and Tripp's mean contact at the mean film beside resolved limits.
//!
//! ```text
//! cargo run --release -p studies --bin averaged_contact
//! ```
//!
//! The limits are those of `docs/reference.csv`, means over its surfaces. The mean gap carries the flow of the smooth contact's film; the
//! mean contact pressure at the separation that has this gap, over the mean Hertz pressure, is the share.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program that talks to its user")]

use std::error::Error;
use std::f64::consts::{LN_10, PI};
use std::process::ExitCode;

use stribeck::analytic::{GreenwoodTripp, PatirCheng};
use stribeck::sim::scene::GridSpec;
use stribeck::sim::{MixedLubricationSim, Scene};
use stribeck::surface::Form;

const LIMITS: &str = include_str!("../../docs/reference.csv");
/// Lowest separation of the mean planes over Rq.
const LOWEST: f64 = -4.0;

/// Contacts of one scene and speed.
struct Contact {
    name: String,
    radius: f64,
    size: f64,
    rq: f64,
    length: f64,
    speed: f64,
    load_ratios: Vec<f64>,
}

fn main() -> ExitCode {
    match work() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("averaged_contact: {error}");
            ExitCode::FAILURE
        }
    }
}

fn work() -> Result<(), Box<dyn Error>> {
    println!("| scene | speed, m/s | lambda | resolved | Greenwood and Tripp | closed form of the inlets |");
    println!("|---|---|---|---|---|---|");
    let (mut sums, contacts) = ([0.0; 2], contacts()?);
    for contact in &contacts {
        let resolved = contact.load_ratios.iter().sum::<f64>() / contact.load_ratios.len() as f64;
        let [lambda, averaged, inlets] = estimates(contact)?;
        sums[0] += (averaged - resolved).abs();
        sums[1] += (inlets - resolved).abs();
        let Contact { name, speed, .. } = contact;
        println!("| {name} | {speed} | {lambda:.3} | {resolved:.2} | {averaged:.2} | {inlets:.2} |");
    }
    let [averaged, inlets] = sums.map(|sum| sum / contacts.len() as f64);
    println!("| mean error | | | | {averaged:.2} | {inlets:.2} |");
    Ok(())
}

/// The contacts with mass-conserving cavitation.
fn contacts() -> Result<Vec<Contact>, Box<dyn Error>> {
    let mut all: Vec<Contact> = Vec::new();
    for line in LIMITS.lines().filter(|line| line.contains(",mass_conserving,")) {
        let fields: Vec<&str> = line.split(',').collect();
        let at =
            |k: usize| -> Result<f64, Box<dyn Error>> { Ok(fields.get(k).ok_or("a short line")?.parse()?) };
        let (name, speed, load_ratio) = (fields.first().ok_or("an empty line")?, at(7)?, at(13)?);
        match all
            .iter_mut()
            .find(|contact| contact.name == *name && contact.speed.to_bits() == speed.to_bits())
        {
            Some(contact) => contact.load_ratios.push(load_ratio),
            None => all.push(Contact {
                name: (*name).to_owned(),
                radius: at(1)?,
                size: at(2)?,
                rq: at(3)?.hypot(at(4)?),
                length: at(5)?,
                speed,
                load_ratios: vec![load_ratio],
            }),
        }
    }
    Ok(all)
}

/// Lambda of the smooth film, and the share of solids by Greenwood and Tripp and by the closed form of the inlets.
fn estimates(contact: &Contact) -> Result<[f64; 3], Box<dyn Error>> {
    let mut scene = Scene::azam_2019(64);
    scene.form = Form::Sphere { radius: contact.radius };
    let half = 0.5 * contact.size;
    scene.grid = GridSpec::Cells { nx: 64, ny: 64, x: [-half, half], y: [-half, half] };
    scene.motion.entrainment_speed = contact.speed;
    let (oil, film_cutoff) = (scene.oil_numbers()?.ok_or("no oil")?, scene.solver.film_cutoff);
    let modulus = scene.equivalent_modulus()?;
    let sim = MixedLubricationSim::builder(scene).build()?;
    let film = sim.expectation()?.film.ok_or("no film")?;
    let lambda = film.central / contact.rq;
    let share = summits(contact, modulus)?.pressure(separation(lambda)?) / (2.0 / 3.0 * sim.hertz().pressure);
    let inlets = stribeck::analytic::MixedLoadShare {
        entrainment_speed: contact.speed,
        eta0: oil.eta0,
        alpha: oil.alpha,
        correlation_length: contact.length,
        contact_film: film_cutoff,
        composite_rq: contact.rq,
    };
    Ok([lambda, share.min(1.0), inlets.load_ratio()?])
}

/// Asperities of an isotropic Gaussian surface with Gaussian autocorrelation, by its spectral moments: density
/// `m4/(6 pi sqrt(3) m2)`, radius `3 sqrt(pi)/(8 sqrt(m4))`.
fn summits(contact: &Contact, modulus: f64) -> Result<GreenwoodTripp, Box<dyn Error>> {
    let rate = LN_10 / contact.length.powi(2);
    let [m2, m4] = [2.0 * rate * contact.rq.powi(2), 12.0 * (rate * contact.rq).powi(2)];
    let density = m4 / (6.0 * PI * 3.0_f64.sqrt() * m2);
    let radius = 3.0 * PI.sqrt() / (8.0 * m4.sqrt());
    Ok(GreenwoodTripp::new(density * radius * contact.rq, contact.rq / radius, modulus)?)
}

/// The separation at which the mean gap over Rq is `lambda`, by bisection.
fn separation(lambda: f64) -> Result<f64, Box<dyn Error>> {
    let law = PatirCheng::new(1.0)?;
    let [mut low, mut high] = [LOWEST, lambda];
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if law.mean_gap(middle) > lambda { high = middle } else { low = middle }
    }
    Ok(0.5 * (low + high))
}
