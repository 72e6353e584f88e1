//! An oil by free volume, whose constants are of no oil in particular.

use stribeck::lubricant::DoolittleTaitConstants;

pub(crate) const FREE_VOLUME: DoolittleTaitConstants = DoolittleTaitConstants {
    viscosity: 0.02,
    temperature: 313.15,
    b: 4.0,
    r0: 0.65,
    epsilon: -8e-4,
    k0_slope: 11.0,
    k00: 9e9,
    beta: 6e-3,
    expansion: 8e-4,
};
