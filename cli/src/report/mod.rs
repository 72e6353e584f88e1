//! `--report`: one HTML file with scene, warnings, numbers and pictures. It needs no network.
//!
//! Scripts draw pictures that are read off with the pointer (uPlot, in `uplot/` with its licence). Print and readers without
//! scripts have the pictures of `--plot`.

mod bearing_numbers;
mod fields;
mod numbers;

use std::error::Error;
use std::fs;
use std::path::Path;

use serde_json::{Value, json};
use stribeck::Status;

pub(crate) use self::bearing_numbers::bearing;
pub(crate) use self::fields::Fields;
pub(crate) use self::numbers::{ErrorOf, Number, all, contact, lines, list, rows};
use crate::picture::{self, Chart, Maps, Scale};
use crate::{files, output};

/// Height of a printed page of pictures and of a row of maps on it \[mm\], and the maps in a row.
const PAGE: u32 = 235;
const ROW: u32 = 62;
const IN_ROW: usize = 3;

/// Text, numbers and pictures of the page.
pub(crate) struct Report {
    title: String,
    status: String,
    is_good: bool,
    scene: String,
    warnings: Vec<String>,
    numbers: String,
    charts: Vec<Value>,
    fields: Option<Value>,
    stills: String,
    /// Height of a chart in print \[mm\].
    chart_height: u32,
}

impl Report {
    /// A report of `command` on the file `scene`.
    pub(crate) fn new(scene: &Path, command: &str, status: Status) -> Result<Self, String> {
        let text = fs::read_to_string(scene).map_err(|error| files::named(scene, &error))?;
        Ok(Self {
            title: format!("{}: {command}", output::stem(scene)),
            status: status.to_string(),
            is_good: status == Status::Converged,
            scene: text,
            warnings: Vec::new(),
            numbers: String::new(),
            charts: Vec::new(),
            fields: None,
            stills: String::new(),
            chart_height: PAGE,
        })
    }

    /// Warnings, each once.
    pub(crate) fn warn(&mut self, warnings: impl IntoIterator<Item = String>) {
        for warning in warnings {
            if !self.warnings.contains(&warning) {
                self.warnings.push(warning);
            }
        }
    }

    /// The reason why a cycle, curve or run has fewer contacts than were asked for.
    pub(crate) fn end_early(&mut self, reason: &str) {
        (self.status, self.is_good) = (reason.to_owned(), false);
    }

    /// A table of numbers, as [`list`], [`rows`] or [`all`] make it.
    pub(crate) fn table(&mut self, table: &str) {
        self.numbers += table;
    }

    pub(crate) fn chart(&mut self, chart: &Chart) -> Result<(), Box<dyn Error>> {
        self.charts.push(chart_data(chart));
        let svg = picture::svg(chart)?;
        // A declaration or a comment before the element has no place in a page.
        let element = svg.find("<svg").map_or("", |start| &svg[start..]);
        self.stills += &format!("<div class=\"still\">{}</div>\n", sized_by_page(element));
        Ok(())
    }

    /// The maps of the last contact, and the `fields` that the scripts draw.
    pub(crate) fn maps(&mut self, maps: Option<&Maps<'_>>, fields: &Fields) -> Result<(), Box<dyn Error>> {
        self.fields = fields.to_json();
        if let Some(maps) = maps {
            let mut images = String::new();
            for map in &maps.maps {
                let title = escape(&format!("{}, {}", maps.title, map.title));
                let one = Maps { title: String::new(), maps: vec![map.clone()], ..*maps };
                let data = fields::base64(&picture::png(&one)?);
                images += &format!("<img alt=\"{title}\" src=\"data:image/png;base64,{data}\"/>");
            }
            self.stills += &format!("<div class=\"still maps\">{images}</div>\n");
            self.chart_height = PAGE.saturating_sub(ROW * maps.maps.len().div_ceil(IN_ROW) as u32);
        }
        Ok(())
    }

    pub(crate) fn write(&self, path: &Path) -> Result<(), Box<dyn Error>> {
        files::write(path, self.to_html().as_bytes())
    }

    fn to_html(&self) -> String {
        let items: String = self.warnings.iter().map(|text| format!("<li>{}</li>", escape(text))).collect();
        let warnings = if items.is_empty() {
            String::new()
        } else {
            format!("<section class=\"warnings\"><h2>Warnings</h2><ul>{items}</ul></section>")
        };
        let style = format!("{}\n{}", include_str!("uplot/uPlot.min.css"), include_str!("page.css"));
        let data = json!({"charts": self.charts, "fields": self.fields}).to_string();
        let parts = [
            ("{{title}}", escape(&self.title)),
            ("{{style}}", style),
            ("{{class}}", if self.is_good { "ok" } else { "failed" }.to_owned()),
            ("{{status}}", escape(&self.status)),
            ("{{warnings}}", warnings),
            ("{{numbers}}", self.numbers.clone()),
            ("{{scene}}", scene_text(&self.scene)),
            ("{{stills}}", self.stills.clone()),
            ("{{height}}", self.chart_height.to_string()),
            ("{{version}}", env!("CARGO_PKG_VERSION").to_owned()),
            // JSON in a page: no character of it may begin a tag.
            ("{{data}}", data.replace('<', "\\u003c").replace('>', "\\u003e").replace('&', "\\u0026")),
            ("{{library}}", include_str!("uplot/uPlot.iife.min.js").to_owned()),
            ("{{script}}", include_str!("page.js").to_owned()),
        ];
        let mut page = String::new();
        let mut rest = include_str!("page.html");
        // Each part once, in the order of the page; text of the scene is not searched.
        while let Some((head, tail)) = rest.split_once("{{") {
            let Some((name, after)) = tail.split_once("}}") else { break };
            page += head;
            let part = parts.iter().find(|(key, _)| key.trim_matches(['{', '}']) == name);
            page += part.map_or("", |(_, text)| text.as_str());
            rest = after;
        }
        page + rest
    }
}

/// The drawing with a `viewBox` in place of its size, so that the page scales it.
fn sized_by_page(svg: &str) -> String {
    let Some((head, rest)) = svg.split_once('>') else { return svg.to_owned() };
    let size = |name: &str| {
        let (_, value) = head.split_once(&format!("{name}=\""))?;
        Some(value.split_once('"')?.0.to_owned())
    };
    match (head.contains("viewBox"), size(" width"), size(" height")) {
        (false, Some(width), Some(height)) => format!("{head} viewBox=\"0 0 {width} {height}\">{rest}"),
        _ => svg.to_owned(),
    }
}

/// The scene; in print long arrays have their first line alone.
fn scene_text(scene: &str) -> String {
    let is_numbers = |line: &&str| {
        line.len() > 40
            && line
                .chars()
                .all(|letter| matches!(letter, '0'..='9' | '.' | ',' | ' ' | 'e' | '-' | '+' | '_'))
    };
    let lines: Vec<&str> = scene.trim_end().lines().collect();
    let parts = lines.chunk_by(|a, b| is_numbers(a) == is_numbers(b)).map(|part| match part {
        [first, rest @ ..] if is_numbers(first) && rest.len() > 1 => {
            let [first, more] = [escape(first), escape(&rest.join("\n"))];
            let cut = format!("  ... {} lines ...", rest.len());
            format!("{first}\n<span class=\"more\">{more}</span><span class=\"cut\">{cut}</span>")
        }
        _ => escape(&part.join("\n")),
    });
    parts.collect::<Vec<_>>().join("\n")
}

/// `text` with the characters that a page reads as its own written as entities.
pub(crate) fn escape(text: &str) -> String {
    let printable = text.chars().filter(|letter| !letter.is_control() || matches!(letter, '\n' | '\t'));
    printable
        .collect::<String>()
        .replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

/// Six digits, which are more than a screen shows; null where it is not finite.
fn short(value: f64) -> Value {
    format!("{value:.5e}").parse::<f64>().ok().filter(|value| value.is_finite()).into()
}

fn chart_data(chart: &Chart) -> Value {
    let log = chart.x_scale == Scale::Decades;
    let x = |x: f64| if log { short(10_f64.powf(x)) } else { short(x) };
    let panels = chart.panels.iter().map(|panel| {
        let is_log = panel.y_scale == Scale::Decades;
        let y = |y: f64| if is_log { short(10_f64.powf(y)) } else { short(y) };
        let lines = panel.lines.iter().map(|line| {
            let band = |x: f64, side: usize| {
                line.bands.iter().find(|(at, _)| at.to_bits() == x.to_bits()).map_or(Value::Null, |(_, edges)| y(edges[side]))
            };
            let bands = [0, 1].map(|side| line.points.iter().map(|(at, _)| band(*at, side)).collect::<Vec<_>>());
            let colour = line.colour;
            json!({
                "name": line.name,
                "colour": format!("#{:02x}{:02x}{:02x}", colour.0, colour.1, colour.2),
                "x": line.points.iter().map(|point| x(point.0)).collect::<Vec<_>>(),
                "y": line.points.iter().map(|point| y(point.1)).collect::<Vec<_>>(),
                "band": (!line.bands.is_empty()).then_some(bands),
            })
        });
        json!({"label": panel.y_label, "top": panel.highest, "log": is_log, "lines": lines.collect::<Vec<_>>()})
    });
    json!({"title": chart.title, "x": chart.x_label, "log": log, "panels": panels.collect::<Vec<_>>()})
}
