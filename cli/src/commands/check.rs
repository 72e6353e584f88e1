//! `stribeck check`: whether a scene can be solved and run, what it models and what to expect of it, without
//! solving.

use std::error::Error;
use std::path::PathBuf;

use serde_json::{Value, json};
use stribeck::InputError;
use stribeck::metrics::{composite_rq, height_statistics};
use stribeck::sim::scene::{Exposure, Flash, FrictionSpec, GridSpec, Roughness, Scene, TrackSpec};
use stribeck::sim::{FormulaFilm, HertzContact, MixedLubricationSim, SimError, Warning};

use crate::output::{self, Outcome};

/// Box and cells on which a scene is looked at that picks its own.
const OWN_BOX: f64 = 2.0;
const OWN_CELLS: usize = 64;
/// Memory of a node \[kB\], as `docs/scene_contact.md` has it.
const LUBRICATED_MEMORY: f64 = 2.0;
const DRY_MEMORY: f64 = 0.4;

/// Warnings go to standard error.
#[derive(clap::Args)]
pub(crate) struct Options {
    /// Scene file
    scene: PathBuf,
    /// Print one JSON object in SI units on standard output
    #[arg(long)]
    json: bool,
}

/// A part of the model, whether it is there, and why.
struct Part {
    what: &'static str,
    modelled: bool,
    why: String,
}

/// Why a scene is refused as a single contact, and as a history; none of it where it is not.
struct Refusals {
    solve: Option<SimError>,
    run: Option<SimError>,
}

/// What is known of a scene before it is solved.
struct Expected {
    refusals: Refusals,
    parts: Vec<Part>,
    hertz: HertzContact,
    formula: Option<FormulaFilm>,
    /// Root mean square heights of ball and disc on the grid \[m\].
    rq: [f64; 2],
    /// The grid is picked by the solve.
    picks_grid: bool,
    lubricated: bool,
    warnings: Vec<Warning>,
    sim: MixedLubricationSim,
}

pub(crate) fn run(options: &Options) -> Result<Outcome, Box<dyn Error>> {
    let scene = output::load(&options.scene)?;
    let expected = Expected::of(&scene).map_err(|error| output::in_scene(&options.scene, error.as_ref()))?;
    let numbers = expected.to_json()?;
    output::warn(&expected.warnings);
    if options.json {
        output::print(&numbers)?;
    } else {
        output::print(&expected.to_text())?;
    }
    Ok(Outcome::Converged)
}

impl Expected {
    /// # Errors
    /// That of a single contact, where neither it nor a history can be made of the scene.
    fn of(scene: &Scene) -> Result<Self, Box<dyn Error>> {
        let builder = || MixedLubricationSim::builder(scene.clone());
        let (warnings, refusals) = match (builder().check_contact(), builder().check()) {
            (Err(solve), Err(_)) => return Err(solve.into()),
            (Ok(warnings), run) => (warnings, Refusals { solve: None, run: run.err() }),
            (Err(solve), Ok(warnings)) => (warnings, Refusals { solve: Some(solve), run: None }),
        };
        let picks_grid = matches!(scene.grid, GridSpec::Accuracy { .. });
        let hertz = scene.hertz()?;
        let mut on_grid = scene.clone();
        if picks_grid {
            on_grid.grid = own_grid(scene, &hertz);
        }
        if refusals.run.is_some() {
            leave_contact(&mut on_grid)?;
        }
        let sim = MixedLubricationSim::builder(on_grid).build()?;
        let mut rq = [0.0; 2];
        for (rq, body) in rq.iter_mut().zip(sim.bodies()) {
            *rq = height_statistics(&sim.track_roughness(body.initial())?)?.sq;
        }
        Ok(Self {
            refusals,
            parts: parts(scene, &sim)?,
            hertz,
            formula: scene.formula_film()?,
            rq,
            picks_grid,
            lubricated: scene.is_lubricated(),
            warnings,
            sim,
        })
    }

    /// Film by formula over roughness; none without either.
    fn lambda(&self) -> Option<f64> {
        let rq = composite_rq(self.rq[0], self.rq[1]);
        self.formula.filter(|_| rq > 0.0).map(|formula| formula.central / rq)
    }

    /// Cells in a Hertz half-width.
    fn cells(&self) -> f64 {
        let grid = self.sim.grid();
        let [half_x, half_y] = self.hertz.half_extents();
        let across = if grid.ny() > 1 { half_y / grid.dy() } else { f64::INFINITY };
        (half_x / grid.dx()).min(across)
    }

    /// Distance of the edges of the box along x from the middle, in Hertz half-widths.
    fn room(&self) -> [f64; 2] {
        let grid = self.sim.grid();
        let low = grid.x(0) - 0.5 * grid.dx();
        [-low, low + grid.size_x()].map(|distance| distance / self.hertz.half_extents()[0])
    }

    fn memory(&self) -> f64 {
        let bytes = if self.lubricated { LUBRICATED_MEMORY } else { DRY_MEMORY };
        1e3 * bytes * self.sim.grid().len() as f64
    }

    fn to_json(&self) -> Result<Value, serde_json::Error> {
        let parts: Vec<Value> = self
            .parts
            .iter()
            .map(|part| json!({ "what": part.what, "modelled": part.modelled, "why": part.why }))
            .collect();
        let (hertz, grid, [inlet, outlet]) = (&self.hertz, self.sim.grid(), self.room());
        let grid = (!self.picks_grid).then(|| {
            json!({
                "nx": grid.nx(), "ny": grid.ny(), "dx": grid.dx(), "dy": grid.dy(),
                "cells_in_half_width": self.cells(),
                "inlet_in_half_widths": inlet,
                "outlet_in_half_widths": outlet,
                "memory": self.memory(),
            })
        });
        let refused = |error: &Option<SimError>| error.as_ref().map(ToString::to_string);
        Ok(json!({
            "refused": { "solve": refused(&self.refusals.solve), "run": refused(&self.refusals.run) },
            "modelled": parts,
            "hertz": hertz,
            "moes": self.formula.map(|formula| formula.moes),
            "film": {
                "formula_central": self.formula.map(|formula| formula.central),
                "formula_lambda": self.lambda(),
            },
            "roughness": {
                "ball_rq": self.rq[0],
                "disc_rq": self.rq[1],
                "composite_rq": composite_rq(self.rq[0], self.rq[1]),
            },
            "flash_estimate": self.sim.flash_estimate(),
            "grid": grid,
            "warnings": serde_json::to_value(&self.warnings)?,
            "version": env!("CARGO_PKG_VERSION"),
        }))
    }

    fn to_text(&self) -> String {
        let mut text = String::new();
        let whole = [("solve", &self.refusals.solve), ("run", &self.refusals.run)];
        for (command, refusal) in whole {
            let (sign, why) = match refusal {
                None => ("yes", format!("`stribeck {command}` takes it")),
                Some(error) => ("no ", error.to_string()),
            };
            text += &format!("{command:<16} {sign}  {why}\n");
        }
        for part in &self.parts {
            let sign = if part.modelled { "yes" } else { "no " };
            text += &format!("{:<16} {sign}  {}\n", part.what, part.why);
        }
        let hertz = &self.hertz;
        text += &format!(
            "Hertz            {:.4} GPa, {:.4} N, half-widths {:.2} x {:.2} um\n",
            hertz.pressure * 1e-9,
            hertz.force,
            hertz.half_width_x * 1e6,
            hertz.half_width_y * 1e6
        );
        text += &self.film_text();
        let (grid, [inlet, outlet]) = (self.sim.grid(), self.room());
        if self.picks_grid {
            return text + "mesh             picked by the solve for the accuracy that is asked for";
        }
        text += &format!(
            "mesh             {} x {} cells, {:.1} in a Hertz half-width; the box ends {inlet:.2} half-widths before and {outlet:.2} \
             behind the middle; about {:.0} MB\n",
            grid.nx(),
            grid.ny(),
            self.cells(),
            1e-6 * self.memory()
        );
        text + "                 its error is estimated with `estimate = true` in [solver] (two solves); `accuracy = 0.01` in place of \
                the cells picks a mesh"
    }

    fn film_text(&self) -> String {
        let [ball, disc] = self.rq.map(|rq| 1e9 * rq);
        let rq = format!("Rq of ball and disc {ball:.1} and {disc:.1} nm");
        let Some(formula) = self.formula else { return format!("film             none, dry; {rq}\n") };
        let (film, m, l) = (1e9 * formula.central, formula.moes.m, formula.moes.l);
        let regime = match self.lambda() {
            None => "smooth: a full film where it is thicker than the contact film".to_owned(),
            Some(lambda) => {
                let regime = match lambda {
                    _ if lambda < 1.0 => "solids carry much of the load",
                    _ if lambda < 3.0 => "mixed lubrication",
                    _ => "a full film",
                };
                format!("lambda {lambda:.3}: {regime}")
            }
        };
        format!(
            "film             {film:.2} nm in the middle by formula (Moes M {m:.1}, L {l:.3}); {rq}; {regime}\n"
        )
    }
}

/// Takes from `scene` what only a history may refuse: it is then looked at as it stands at the start.
fn leave_contact(scene: &mut Scene) -> Result<(), InputError> {
    let start = scene.conditions(0.0)?;
    (scene.load.force, scene.load.hertz_pressure) = (Some(start.load), None);
    (scene.motion, scene.thermal.bulk_temperature) = (start.motion, start.bulk_temperature);
    (scene.schedule, scene.track) = (Default::default(), TrackSpec::default());
    Ok(())
}

/// Cells on which a scene is looked at that picks its own.
fn own_grid(scene: &Scene, hertz: &HertzContact) -> GridSpec {
    let edges = |half_width: f64| [-OWN_BOX * half_width, OWN_BOX * half_width];
    let [half_x, half_y] = hertz.half_extents();
    let (n, x) = (OWN_CELLS, edges(half_x));
    if scene.form.is_line() {
        GridSpec::Row { nx: n, x }
    } else {
        GridSpec::Cells { nx: n, ny: n, x, y: edges(half_y) }
    }
}

fn parts(scene: &Scene, sim: &MixedLubricationSim) -> Result<Vec<Part>, InputError> {
    let part = |what, modelled, why: &str| Part { what, modelled, why: why.to_owned() };
    let mut parts = vec![
        if scene.form.is_line() {
            part("line contact", true, "form.kind is a cylinder: one row of cells, loads per metre of length")
        } else {
            part("point contact", true, "form.kind is no cylinder")
        },
        match (&scene.lubricant, scene.is_lubricated()) {
            (_, true) => part("oil", true, "[lubricant] is given"),
            (Some(_), false) => part("oil", false, "solver.kind is dry: the [lubricant] is left out"),
            (None, false) => part("oil", false, "there is no [lubricant]: a dry contact"),
        },
    ];
    if scene.is_lubricated() {
        let starved = scene.lubricant.as_ref().is_some_and(|oil| oil.supplied_film.is_some());
        parts.push(if starved {
            part("starved inlet", true, "lubricant.supplied_film is given")
        } else {
            part("starved inlet", false, "without lubricant.supplied_film the inlet is flooded")
        });
        parts.push(match scene.motion.spin_radius {
            Some(_) => part("spin", true, "motion.spin_radius is given"),
            None => part("spin", false, "without motion.spin_radius the surfaces move along x alone"),
        });
        let warm = scene.lubricant.as_ref().is_some_and(|oil| oil.thermal.is_some());
        parts.push(if warm {
            part("film temperature", true, "lubricant.thermal is given")
        } else {
            part("film temperature", false, "without [lubricant.thermal] the film has the bulk temperature")
        });
        let FrictionSpec { eyring_stress, carreau_stress, flow_thinning, .. } = &scene.friction;
        let law = match (eyring_stress, carreau_stress) {
            (Some(_), _) => "by Eyring, friction.eyring_stress is given",
            (None, Some(_)) => "by Carreau, friction.carreau_stress is given",
            (None, None) => {
                "Newtonian up to its largest stress, without friction.eyring_stress or carreau_stress"
            }
        };
        parts.push(part("shear of the oil", true, law));
        parts.push(match flow_thinning {
            Some(_) => part("flow thinning", true, "friction.flow_thinning is given"),
            None => part(
                "flow thinning",
                false,
                "without friction.flow_thinning sliding leaves the flow by pressure its viscosity",
            ),
        });
    }
    for (what, key, roughness) in [
        ("rough ball", "roughness.ball", &scene.roughness.ball),
        ("rough disc", "roughness.disc", &scene.roughness.disc),
    ] {
        parts.push(Part { what, modelled: !roughness.is_smooth(), why: why_rough(key, roughness) });
    }
    parts.push(sliding(scene)?);
    parts.extend(changes(scene, sim));
    Ok(parts)
}

fn why_rough(key: &str, roughness: &Roughness) -> String {
    match roughness {
        Roughness::None => format!("there is no [{key}]"),
        _ if roughness.is_smooth() => format!("{key}.rq = 0"),
        Roughness::File(file) => format!("measured: {}", file.path.display()),
        _ => format!("[{key}] is given"),
    }
}

fn sliding(scene: &Scene) -> Result<Part, InputError> {
    let modelled =
        scene.conditions(0.0)?.motion.sliding_speed() > 0.0 || scene.schedule.slide_roll_ratio.is_some();
    let why = if modelled {
        "the surfaces slide"
    } else {
        "without sliding there is neither friction nor its heat"
    };
    Ok(Part { what: "friction", modelled, why: why.to_owned() })
}

/// What changes the surfaces, in a history.
fn changes(scene: &Scene, sim: &MixedLubricationSim) -> Vec<Part> {
    let table = |what, given: bool, key: &str, history: bool| Part {
        what,
        modelled: given,
        why: match (given, history) {
            (false, _) => format!("there is no [{key}]"),
            (true, false) => format!("[{key}] is given"),
            (true, true) => format!("[{key}] is given; in a history alone"),
        },
    };
    let (rise, on) = (sim.flash_estimate(), sim.models_flash_temperature());
    let why = match scene.thermal.flash {
        Flash::On => format!("thermal.flash is on; estimated rise {rise:.2} K"),
        Flash::Off => format!("thermal.flash is off; estimated rise {rise:.2} K"),
        _ => format!("estimated rise {rise:.2} K, it counts from 1 K on; in a history alone"),
    };
    let scheduled = !scene.schedule.is_empty();
    let exposures = [
        ("track.exposure", Some(scene.track.exposure)),
        ("wear.exposure", scene.wear.map(|wear| wear.exposure)),
    ];
    let on_track = exposures.into_iter().find(|(_, exposure)| *exposure == Some(Exposure::Track));
    vec![
        table("plastic limit", scene.plastic.is_some(), "plastic", false),
        table("tribofilm", scene.tribofilm.is_some(), "tribofilm", true),
        table("wear", scene.wear.is_some(), "wear", true),
        Part { what: "flash heat", modelled: on, why },
        table("schedule", scheduled, "schedule", true),
        Part {
            what: "time on track",
            modelled: on_track.is_some(),
            why: on_track.map_or_else(
                || "points age as if they never left the contact".to_owned(),
                |(key, _)| format!("{key} is track"),
            ),
        },
    ]
}
