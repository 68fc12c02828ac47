//! Plots: views over objects, as in Figs. 9 and 10 of the paper, and coverage over views.

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::study::design::Design;
use crate::study::error::StudyError;
use crate::study::statistics::Interval;
use crate::study::summary::{Line, Summary};

/// A plot as SVG.
pub struct Plot {
    /// Name of its file.
    pub name: &'static str,
    /// What it shows.
    pub title: String,
    /// The drawing.
    pub svg: String,
}

/// Size of a plot, pixels.
const SIZE: (u32, u32) = (960, 480);
/// Room for the legend beside the objects, as a share of theirs.
const LEGEND: f64 = 0.2;
/// Face and size of all letters.
const LETTERS: (&str, u32) = ("sans-serif", 14);
/// Colours that differ for colour-blind eyes too (Tol's bright and muted schemes).
const COLOURS: [RGBColor; 14] = [
    RGBColor(0x44, 0x77, 0xaa),
    RGBColor(0xee, 0x66, 0x77),
    RGBColor(0x22, 0x88, 0x33),
    RGBColor(0xcc, 0xbb, 0x44),
    RGBColor(0x66, 0xcc, 0xee),
    RGBColor(0xaa, 0x33, 0x77),
    RGBColor(0x99, 0x99, 0x33),
    RGBColor(0x88, 0x22, 0x55),
    RGBColor(0x33, 0x22, 0x88),
    RGBColor(0xdd, 0xcc, 0x77),
    RGBColor(0x11, 0x77, 0x33),
    RGBColor(0x44, 0xaa, 0x99),
    RGBColor(0x33, 0x33, 0x33),
    RGBColor(0x99, 0x99, 0x99),
];

/// All plots of a study.
///
/// # Errors
/// One cannot be drawn.
pub fn plots(design: &Design, summary: &Summary) -> Result<Vec<Plot>, StudyError> {
    let plot = |name, title: &str, svg| Plot {
        name,
        title: title.to_owned(),
        svg,
    };
    let mut out = vec![plot(
        "views",
        "Views to the stop, by object",
        over_objects(design, summary, |line| line.views)?,
    )];
    if !design.is_recognition() {
        let to97 = over_objects(design, summary, |line| line.to[1])?;
        out.push(plot("views-to-97", "Views to 97 % coverage, by object", to97));
        let curves = over_views(design, summary)?;
        out.push(plot("coverage", "Mean coverage over views", curves));
    }
    Ok(out)
}

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Draws on a white sheet.
fn drawn(draw: impl FnOnce(&Area<'_>) -> Result<(), String>) -> Result<String, StudyError> {
    let mut svg = String::new();
    {
        let area = SVGBackend::with_string(&mut svg, SIZE).into_drawing_area();
        let done = area.fill(&WHITE).map_err(|e| e.to_string()).and_then(|()| draw(&area));
        done.and_then(|()| area.present().map_err(|e| e.to_string()))
            .map_err(StudyError::Plot)?;
    }
    Ok(svg)
}

fn over_objects(design: &Design, summary: &Summary, of: fn(&Line) -> Option<Interval>) -> Result<String, StudyError> {
    let objects: Vec<&str> = design.study.objects.iter().map(|s| s.object.name.as_str()).collect();
    let value = |arm: usize, object: &str| summary.line(arm, object).and_then(of);
    let all = (0..design.arms.len()).flat_map(|arm| objects.iter().filter_map(move |o| Some(value(arm, o)?.high)));
    let top = all.fold(1.0_f64, f64::max) * 1.05;
    let arms = design.arms.len() as f64;
    drawn(|area| {
        let mut chart = ChartBuilder::on(area)
            .margin(12)
            .x_label_area_size(44)
            .y_label_area_size(52)
            .build_cartesian_2d(-0.5..objects.len() as f64 * (1.0 + LEGEND) - 0.5, 0.0..top)
            .map_err(|e| e.to_string())?;
        let name = |x: &f64| {
            let near = (x - x.round()).abs() < 0.01 && *x > -0.01;
            objects
                .get(x.round() as usize)
                .filter(|_| near)
                .map_or(String::new(), |o| (*o).to_owned())
        };
        chart
            .configure_mesh()
            .disable_x_mesh()
            .light_line_style(TRANSPARENT)
            .label_style(LETTERS)
            .x_labels((3 * objects.len()).clamp(2, 90))
            .x_label_formatter(&name)
            .x_desc("object")
            .y_desc("views")
            .draw()
            .map_err(|e| e.to_string())?;
        for (arm, settings) in design.arms.iter().enumerate() {
            let colour = COLOURS[arm % COLOURS.len()];
            // Side by side, so that intervals do not hide each other.
            let shift = 0.6 * ((arm as f64 + 0.5) / arms - 0.5);
            let points: Vec<(f64, Interval)> = objects
                .iter()
                .enumerate()
                .filter_map(|(k, object)| Some((k as f64 + shift, value(arm, object)?)))
                .collect();
            let bars = points
                .iter()
                .map(|(x, i)| PathElement::new(vec![(*x, i.low), (*x, i.high)], colour.stroke_width(1)));
            chart.draw_series(bars).map_err(|e| e.to_string())?;
            let dots = points
                .iter()
                .map(|(x, i)| Circle::new((*x, i.mean), 4, colour.filled()));
            let series = chart.draw_series(dots).map_err(|e| e.to_string())?;
            series
                .label(settings.label.clone())
                .legend(move |(x, y)| Circle::new((x + 8, y), 4, colour.filled()));
        }
        legend(&mut chart)
    })
}

fn over_views(design: &Design, summary: &Summary) -> Result<String, StudyError> {
    let longest = summary.curves.iter().map(Vec::len).max().unwrap_or(0).max(2);
    let least = summary
        .curves
        .iter()
        .filter_map(|c| c.first())
        .copied()
        .fold(1.0_f64, f64::min);
    drawn(|area| {
        let mut chart = ChartBuilder::on(area)
            .margin(12)
            .x_label_area_size(44)
            .y_label_area_size(60)
            .build_cartesian_2d(1.0..longest as f64, (least * 100.0).floor()..100.0)
            .map_err(|e| e.to_string())?;
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .label_style(LETTERS)
            .x_desc("views")
            .y_desc("coverage, %")
            .x_labels(longest.min(20))
            .x_label_formatter(&|x| format!("{x:.0}"))
            .draw()
            .map_err(|e| e.to_string())?;
        for (arm, curve) in summary.curves.iter().enumerate().filter(|(_, c)| !c.is_empty()) {
            let colour = COLOURS[arm % COLOURS.len()];
            let points = curve.iter().enumerate().map(|(k, c)| (k as f64 + 1.0, c * 100.0));
            let line = LineSeries::new(points, colour.stroke_width(2));
            let series = chart.draw_series(line).map_err(|e| e.to_string())?;
            series
                .label(design.arms[arm].label.clone())
                .legend(move |(x, y)| PathElement::new(vec![(x, y), (x + 16, y)], colour.stroke_width(2)));
        }
        legend(&mut chart)
    })
}

type Chart<'a, 'b> = ChartContext<
    'a,
    SVGBackend<'b>,
    Cartesian2d<plotters::coord::types::RangedCoordf64, plotters::coord::types::RangedCoordf64>,
>;

fn legend<'a, 'b: 'a>(chart: &mut Chart<'a, 'b>) -> Result<(), String> {
    chart
        .configure_series_labels()
        .label_font(LETTERS)
        .background_style(WHITE.mix(0.85))
        .border_style(BLACK.mix(0.3))
        .position(SeriesLabelPosition::LowerRight)
        .draw()
        .map_err(|e| e.to_string())
}
