//! A plot as SVG: axes, lines, points and a legend.

use std::fmt::Write;

use super::escape::escape;
use super::scale::Scale;

const WIDTH: f64 = 640.0;
const HEIGHT: f64 = 380.0;
/// Where the axes are.
const LEFT: f64 = 70.0;
const RIGHT: f64 = 400.0;
const TOP: f64 = 34.0;
const BOTTOM: f64 = 330.0;

/// Colours that colour-blind people can tell apart too (`okabe2008`).
const COLORS: [&str; 8] = [
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#000000", "#8a8a8a",
];

/// Points that belong together.
pub struct Series {
    pub name: String,
    pub points: Vec<[f64; 2]>,
    /// Figures of others are drawn hollow and dashed.
    pub is_reference: bool,
}

/// What is drawn.
pub struct Plot {
    pub title: String,
    pub x: &'static str,
    pub y: &'static str,
    /// Whether the vertical axis is logarithmic, as the horizontal one always is.
    pub log_y: bool,
    /// Whether points are joined.
    pub lines: bool,
    pub series: Vec<Series>,
}

impl Plot {
    /// The SVG element, to stand in an HTML page.
    pub fn svg(&self) -> String {
        let all = || self.series.iter().flat_map(|s| &s.points);
        let x = Scale::log(all().map(|p| p[0]), [LEFT, RIGHT]);
        let y_pixels = [BOTTOM, TOP];
        let y = match self.log_y {
            true => Scale::log(all().map(|p| p[1]), y_pixels),
            false => Scale::linear(all().map(|p| p[1]), y_pixels),
        };
        let mut svg = format!("<svg viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\">\n");
        let title = escape(&self.title);
        let _ = writeln!(svg, "<title>{title}</title>");
        let _ = writeln!(
            svg,
            "<text x=\"{LEFT}\" y=\"18\" class=\"title\">{title}</text>"
        );
        self.axes(&mut svg, &x, &y);
        for (k, series) in self.series.iter().enumerate() {
            self.draw(&mut svg, series, COLORS[k % COLORS.len()], &x, &y);
            legend(&mut svg, series, COLORS[k % COLORS.len()], k);
        }
        svg + "</svg>\n"
    }

    fn axes(&self, svg: &mut String, x: &Scale, y: &Scale) {
        for tick in x.ticks() {
            let at = x.pixel(tick);
            let _ = writeln!(
                svg,
                "<path d=\"M{at:.1} {TOP}V{BOTTOM}\" class=\"grid\"/>\
                 <text x=\"{at:.1}\" y=\"{:.1}\" class=\"x\">{}</text>",
                BOTTOM + 16.0,
                short(tick)
            );
        }
        for tick in y.ticks() {
            let at = y.pixel(tick);
            let _ = writeln!(
                svg,
                "<path d=\"M{LEFT} {at:.1}H{RIGHT}\" class=\"grid\"/>\
                 <text x=\"{:.1}\" y=\"{:.1}\" class=\"y\">{}</text>",
                LEFT - 6.0,
                at + 4.0,
                short(tick)
            );
        }
        let middle = 0.5 * (LEFT + RIGHT);
        let _ = writeln!(
            svg,
            "<text x=\"{middle:.1}\" y=\"{:.1}\" class=\"x\">{}</text>\
             <text x=\"{:.1}\" y=\"{TOP}\" class=\"y\">{}</text>",
            BOTTOM + 36.0,
            escape(self.x),
            LEFT - 6.0,
            escape(self.y)
        );
    }

    fn draw(&self, svg: &mut String, series: &Series, color: &str, x: &Scale, y: &Scale) {
        let at = |p: &[f64; 2]| [x.pixel(p[0]), y.pixel(p[1])];
        if self.lines {
            let points: Vec<String> = series
                .points
                .iter()
                .map(at)
                .map(|[a, b]| format!("{a:.1},{b:.1}"))
                .collect();
            let dashes = if series.is_reference { "4 3" } else { "none" };
            let _ = writeln!(
                svg,
                "<polyline points=\"{}\" fill=\"none\" stroke=\"{color}\" stroke-dasharray=\"{dashes}\"/>",
                points.join(" ")
            );
        }
        for [a, b] in series.points.iter().map(at) {
            let _ = writeln!(svg, "{}", dot(a, b, series, color));
        }
    }
}

fn dot(x: f64, y: f64, series: &Series, color: &str) -> String {
    let fill = if series.is_reference { "white" } else { color };
    format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4\" fill=\"{fill}\" stroke=\"{color}\"/>")
}

fn legend(svg: &mut String, series: &Series, color: &str, k: usize) {
    let y = TOP + 10.0 + 18.0 * k as f64;
    let name = escape(&series.name);
    let _ = writeln!(
        svg,
        "{}<text x=\"{:.1}\" y=\"{:.1}\">{name}</text>",
        dot(RIGHT + 20.0, y, series, color),
        RIGHT + 30.0,
        y + 4.0
    );
}

/// 20000 is 20k.
fn short(value: f64) -> String {
    let rounded = (value * 1e6).round() / 1e6;
    match rounded.abs() {
        m if m >= 1e6 => format!("{}M", rounded / 1e6),
        m if m >= 1e4 => format!("{}k", rounded / 1e3),
        _ => rounded.to_string(),
    }
}
