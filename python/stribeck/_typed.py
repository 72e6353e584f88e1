"""Names of numbers for type checkers. At run time each table is a :class:`~stribeck._numbers.Numbers`; a test compares these classes with the results
of solves and steps."""

from __future__ import annotations

from ._numbers import Numbers


class Residual(Numbers):
    """Residuals of the equations."""

    __slots__ = ()
    mass: float
    load: float
    complementarity: float


class Work(Numbers):
    """Work of a solve."""

    __slots__ = ()
    convolutions: float
    iterations: int
    inner_iterations: int


class Hertz(Numbers):
    """The smooth dry contact."""

    __slots__ = ()
    half_width_x: float
    half_width_y: float
    angle: float
    radius: float
    area: float
    pressure: float
    force: float


class Moes(Numbers):
    """Dimensionless load and material parameter."""

    __slots__ = ()
    m: float
    l: float  # noqa: E741


class Film(Numbers):
    """Film thickness."""

    __slots__ = ()
    central: float
    minimum: float
    mean_central: float
    minimum_gap: float
    lambda_: float | None
    minimum_lambda: float | None
    formula_ratio: float | None
    formula_lambda: float | None
    fluid_fraction: float | None


class Pressure(Numbers):
    """Pressures, and the load outside the box."""

    __slots__ = ()
    max: float
    central: float
    mean: float
    load_outside: float


class Contact(Numbers):
    """Solid contact."""

    __slots__ = ()
    area_ratio: float
    load_ratio: float
    area: float
    corrected_area_ratio: float
    corrected_area: float
    plastic_area: float
    film_cutoff: float


class Friction(Numbers):
    """Friction coefficients."""

    __slots__ = ()
    coefficient: float
    boundary: float
    fluid: float
    power_loss: float


class Roughness(Numbers):
    """Rq of both bodies and of both together."""

    __slots__ = ()
    ball_rq: float
    disc_rq: float
    composite_rq: float


class Flow(Numbers):
    """Flow through the box."""

    __slots__ = ()
    inflow: float
    outflow: float
    imbalance: float


class Starvation(Numbers):
    """Film of a starved contact beside that of a flooded one."""

    __slots__ = ()
    flooded_film: float
    film_ratio: float


class Errors(Numbers):
    """Estimated errors."""

    __slots__ = ()
    film_central: float
    film_minimum: float
    pressure_max: float
    film_mean_central: float
    contact_load_ratio: float
    contact_area_ratio: float
    friction_coefficient: float
    film_by_box: float


class Motion(Numbers):
    """Speeds."""

    __slots__ = ()
    entrainment_speed: float
    slide_roll_ratio: float


class Wear(Numbers):
    """Worn depths, volumes and scars."""

    __slots__ = ()
    ball_mean: float
    disc_mean: float
    ball_max: float
    disc_max: float
    ball_in_contact: float
    disc_in_contact: float
    ball_volume: float
    disc_volume: float
    ball_scar_width: float | None
    disc_scar_width: float | None
    ball_scar_depth: float
    disc_scar_depth: float


class Tribofilm(Numbers):
    """Thicknesses of tribofilms."""

    __slots__ = ()
    ball_mean: float
    disc_mean: float
    ball_max: float
    disc_max: float
    ball_in_contact: float
    disc_in_contact: float


class Plastic(Numbers):
    """Plastic flattening."""

    __slots__ = ()
    volume: float


class Extreme(Numbers):
    """A largest stress and its place."""

    __slots__ = ()
    stress: float
    depth: float
    x: float
    y: float


class LayerStress(Numbers):
    """Largest stresses of a layer and of its bond."""

    __slots__ = ()
    von_mises: Extreme
    bond_shear: Extreme
    bond_tension: Extreme
    surface_tension: Extreme


class Stress(Numbers):
    """Largest stresses below the surface."""

    __slots__ = ()
    von_mises: Extreme
    orthogonal_shear: Extreme
    layer: LayerStress | None
    yield_ratio: float | None
    shakedown_ratio: float | None


class Thermal(Numbers):
    """Temperature and heat of the film."""

    __slots__ = ()
    film_temperature_max: float
    film_temperature_mean_central: float
    surface_rise_ball: float
    surface_rise_disc: float
    heat: float
    imbalance: float
    solves: int
    change: float


class Solved(Numbers):
    """A solve."""

    __slots__ = ()
    solver: str
    status: str
    residual: Residual
    energy_error: float | None
    work: Work


class SolvedContact(Solved):
    """The numbers of a contact."""

    __slots__ = ()
    hertz: Hertz
    moes: Moes | None
    film_formula: str | None
    film: Film
    pressure: Pressure
    contact: Contact
    friction: Friction
    roughness: Roughness
    flow: Flow | None
    approach: float
    stress: Stress | None
    thermal: Thermal | None
    flash_rise: float | None
    starvation: Starvation | None
    error_estimate: Errors | None
    strategy: str | None
    model: str | None
    scheme: str | None
    face_mobility: str | None
    cavitation: str | None
    contact_definition: str | None
    version: str
    seconds: float


class Conditions(Numbers):
    """Conditions of a contact."""

    __slots__ = ()
    load: float
    motion: Motion
    bulk_temperature: float


class Oil(Numbers):
    """Viscosity and pressure-viscosity coefficient of the oil at the bulk temperature."""

    __slots__ = ()
    temperature: float
    eta0: float
    eta0_source: str
    alpha: float
    alpha_source: str
    alpha_uncertainty: float
    film_uncertainty: float
    kinematic_viscosity: float
    kappa: float | None


class FilmMap(Numbers):
    """Regime of the film and its thickness with an incompressible oil."""

    __slots__ = ()
    regime: str
    viscosity_parameter: float
    elasticity_parameter: float
    central: float


class ExpectedFilm(Numbers):
    """Film, share of the load on solids and friction by formula."""

    __slots__ = ()
    map: FilmMap
    central: float
    formula: str
    lambda_: float | None
    load_ratio: float | None
    inlet_number: float | None
    load_ratio_range: list[float] | None
    load_ratio_by_contact_film: list[float] | None
    friction_by_contact_film: list[float] | None
    friction: list[float]
    friction_range: list[float] | None
    film_rise: float


class Expectation(Numbers):
    """A contact by formula."""

    __slots__ = ()
    roughness: Roughness
    short_roughness: float
    correlation_length: float | None
    flash_rise: float
    film: ExpectedFilm | None


class Forces(Numbers):
    """Shear forces on both surfaces."""

    __slots__ = ()
    lower: float
    upper: float
