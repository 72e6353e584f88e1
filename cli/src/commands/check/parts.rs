//! The parts of the model that a scene has or leaves out, and the keys that decide.

use serde_json::{Value, json};
use stribeck::InputError;
use stribeck::sim::MixedLubricationSim;
use stribeck::sim::scene::{
    CoatedBody, Exposure, Flash, FrictionSpec, GridSpec, InletSpec, Roughness, Scene,
};

/// The part that is there by one of several laws.
const SHEAR: &str = "shear of the oil";

/// A part of the model, whether it is there, and why.
pub(super) struct Part {
    pub(super) name: &'static str,
    pub(super) modelled: bool,
    pub(super) why: String,
}

impl Part {
    /// Its name; that of the shear says by which law.
    fn full_name(&self) -> String {
        let law = self.why.split(',').next().filter(|_| self.name == SHEAR);
        let of = law.or_else(|| self.why.strip_prefix("elastic.layer: "));
        of.map_or_else(|| self.name.to_owned(), |of| format!("{} {of}", self.name))
    }
}

/// The parts as JSON objects.
pub(super) fn objects(parts: &[Part]) -> Vec<Value> {
    let object = |part: &Part| json!({ "part": part.name, "modelled": part.modelled, "why": part.why });
    parts.iter().map(object).collect()
}

/// The lines of the parts that are modelled and of those that are left out.
pub(super) fn lines(parts: &[Part]) -> [String; 2] {
    let names = |modelled: bool| {
        let parts = parts.iter().filter(|part| part.modelled == modelled);
        parts.map(Part::full_name).collect::<Vec<_>>().join(", ")
    };
    [format!("modelled   {}", names(true)), format!("left out   {} (--json: by which keys)", names(false))]
}

/// Where the oil begins, and whether the box holds the inlet.
fn inlet(scene: &Scene, sim: &MixedLubricationSim) -> Result<Part, InputError> {
    let part = |modelled, why| Ok(Part { name: "flooded inlet", modelled, why });
    let Some(oil) = &scene.lubricant else { return part(false, String::new()) };
    if oil.inlet == InletSpec::BoxEdge {
        return part(false, "lubricant.inlet is box_edge: the oil begins at the edges of the box".to_owned());
    }
    if oil.supplied_film.is_some() {
        return part(false, "lubricant.supplied_film starves it".to_owned());
    }
    let picks_grid = matches!(scene.grid, GridSpec::Accuracy { .. });
    let boxed = sim.inlet()?.filter(|_| !picks_grid).map(|inlet| {
        let error = 100.0 * inlet.film_error;
        if inlet.box_holds_it {
            format!("; the box holds the inlet, its edges thin the film by less than {error:.1} %")
        } else {
            format!("; the box cuts up to {error:.0} % of the film: a smooth contact in a wider box gives the pressure at its edges")
        }
    });
    part(true, format!("oil fills the gap far upstream{}", boxed.unwrap_or_default()))
}

pub(super) fn parts(scene: &Scene, sim: &MixedLubricationSim) -> Result<Vec<Part>, InputError> {
    let part = |name, modelled, why: &str| Part { name, modelled, why: why.to_owned() };
    let mut parts = vec![
        if matches!(scene.grid, GridSpec::Strip { .. }) {
            part(
                "strip",
                true,
                "grid.across is periodic: a line contact whose surfaces repeat across the flow",
            )
        } else if scene.form.is_line() {
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
        parts.push(inlet(scene, sim)?);
        parts.extend(fluid(scene));
    }
    for (name, key, roughness) in [
        ("rough ball", "roughness.ball", &scene.roughness.ball),
        ("rough disc", "roughness.disc", &scene.roughness.disc),
    ] {
        parts.push(Part { name, modelled: !roughness.is_smooth(), why: why_rough(key, roughness) });
    }
    if scene.is_lubricated() && !scene.is_smooth() {
        parts.push(roughness_in_motion(scene)?);
    }
    parts.extend(coating(scene));
    parts.push(sliding(scene)?);
    parts.extend(changes(scene, sim));
    Ok(parts)
}

/// Spin, temperature and shear thinning of the film.
fn fluid(scene: &Scene) -> [Part; 4] {
    let part = |name, modelled, why: &str| Part { name, modelled, why: why.to_owned() };
    let warm = scene.lubricant.as_ref().is_some_and(|oil| oil.thermal.is_some());
    let FrictionSpec { eyring_stress, carreau_stress, flow_thinning, .. } = &scene.friction;
    let law = match (eyring_stress, carreau_stress) {
        (Some(_), _) => "by Eyring, friction.eyring_stress is given",
        (None, Some(_)) => "by Carreau, friction.carreau_stress is given",
        (None, None) => {
            "Newtonian up to its largest stress, without friction.eyring_stress or carreau_stress"
        }
    };
    [
        match scene.motion.spin_radius {
            Some(_) => part("spin", true, "motion.spin_radius is given"),
            None => part("spin", false, "without motion.spin_radius the surfaces move along x alone"),
        },
        if warm {
            part("film temperature", true, "lubricant.thermal is given")
        } else {
            part("film temperature", false, "without [lubricant.thermal] the film has the bulk temperature")
        },
        part(SHEAR, true, law),
        match flow_thinning {
            Some(_) => part("flow thinning", true, "friction.flow_thinning is given"),
            None => part(
                "flow thinning",
                false,
                "without friction.flow_thinning sliding leaves the flow by pressure its viscosity",
            ),
        },
    ]
}

/// The layer on a body.
fn coating(scene: &Scene) -> Option<Part> {
    let layer = scene.elastic.layer?;
    let name = if layer.body == CoatedBody::Ball { "ball" } else { "disc" };
    let hardness =
        layer.hardness.map_or_else(String::new, |hardness| format!(", hardness {:.3} GPa", 1e-9 * hardness));
    Some(Part {
        name: "coating",
        modelled: true,
        why: format!(
            "elastic.layer: {:.3} um on the {name}, modulus {:.1} GPa{hardness}",
            1e6 * layer.thickness,
            1e-9 * layer.modulus
        ),
    })
}

fn why_rough(key: &str, roughness: &Roughness) -> String {
    match roughness {
        Roughness::None => format!("there is no [{key}]"),
        _ if roughness.is_smooth() => format!("{key}.rq = 0"),
        Roughness::File(file) => format!("measured: {}", file.path.display()),
        _ => format!("[{key}] is given"),
    }
}

/// Whether the roughness moves with its body, and the error where it does not.
fn roughness_in_motion(scene: &Scene) -> Result<Part, InputError> {
    let speeds = scene.conditions(0.0)?.motion.surface_speeds();
    let bodies = [&scene.roughness.ball, &scene.roughness.disc];
    let rests = bodies.iter().zip(speeds).all(|(roughness, speed)| roughness.is_smooth() || speed == 0.0);
    let (modelled, why) = match (scene.motion.roughness.is_at_rest(), rests) {
        (false, _) => (true, "motion.roughness is moving: surfaces pass at their speeds, with squeeze"),
        (true, true) => (false, "the rough body is at rest: a steady contact is exact"),
        (true, false) => (
            false,
            "motion.roughness is at_rest, a model: where surfaces with roughness move, the mean film is larger and the least film \
             smaller than in a steady contact (docs/cycles.md)",
        ),
    };
    Ok(Part { name: "moving roughness", modelled, why: why.to_owned() })
}

fn sliding(scene: &Scene) -> Result<Part, InputError> {
    let modelled =
        scene.conditions(0.0)?.motion.sliding_speed() > 0.0 || scene.schedule.slide_roll_ratio.is_some();
    let why = if modelled {
        "the surfaces slide"
    } else {
        "without sliding there is neither friction nor its heat"
    };
    Ok(Part { name: "friction", modelled, why: why.to_owned() })
}

/// Processes that change the surfaces in a history.
fn changes(scene: &Scene, sim: &MixedLubricationSim) -> Vec<Part> {
    let table = |name, given: bool, key: &str, history: bool| Part {
        name,
        modelled: given,
        why: match (given, history) {
            (false, _) => format!("there is no [{key}]"),
            (true, false) => format!("[{key}] is given"),
            (true, true) => format!("[{key}] is given; in a history alone"),
        },
    };
    let on = sim.models_flash_temperature();
    let why = match scene.thermal.flash {
        Flash::On => "thermal.flash is on; in a history alone",
        Flash::Off => "thermal.flash is off",
        _ => "thermal.flash is auto: on where it may exceed 1 K; in a history alone",
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
        Part { name: "flash heat", modelled: on, why: why.to_owned() },
        table("schedule", scheduled, "schedule", true),
        Part {
            name: "time on track",
            modelled: on_track.is_some(),
            why: on_track.map_or_else(
                || "points age as if they never left the contact".to_owned(),
                |(key, _)| format!("{key} is track"),
            ),
        },
    ]
}
