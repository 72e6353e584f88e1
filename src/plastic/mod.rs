//! plastic
