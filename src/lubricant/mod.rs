//! lubricant
