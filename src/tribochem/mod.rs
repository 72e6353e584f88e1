//! Tribochemistry: growth and removal of anti-wear films, their hardness, flash temperature.
