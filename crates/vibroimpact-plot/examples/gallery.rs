//! Draws five typical figures into the directory given as argument.
//!
//! `cargo run -p vibroimpact-plot --example gallery -- /tmp/gallery`
//!
//! The curves are invented: the gallery shows the appearance of figures, and no results.

use std::error::Error;
use std::f64::consts::{PI, TAU};
use std::path::Path;

use vibroimpact_plot::{
    Colour, DPI_300, Dash, Figure, FigureAxis, FilledRegion, HLine, Hatch, Key, Legend, Line, Panel, Pattern, Points,
    Raster, Rects, SERIES, Shape, Stroke, Text, TextSide, Tick, VLine, Wall, class_style, legend_text,
};

fn main() -> Result<(), Box<dyn Error>> {
    let dir = std::env::args().nth(1).ok_or("give the directory to write to")?;
    std::fs::create_dir_all(&dir)?;
    for (name, figure) in
        [("waveform", waveform()), ("basin", basin()?), ("map", map()), ("panels", panels()), ("impacts", impacts())]
    {
        let path = Path::new(&dir).join(name);
        std::fs::write(path.with_extension("svg"), figure.to_svg())?;
        std::fs::write(path.with_extension("png"), figure.to_png(DPI_300)?)?;
    }
    Ok(())
}

/// A motion that hits a stop at ξ = 0.6 twice in a period, sampled much more finely than necessary.
fn motion(to: f64) -> (Vec<f64>, Vec<f64>) {
    let n = 100_000;
    let xs: Vec<f64> = (0..=n).map(|i| to * f64::from(i) / f64::from(n)).collect();
    let ys = xs
        .iter()
        .map(|t| {
            let free = 1.1 * t.sin() + 0.25 * (2.0 * t + 0.6).cos();
            if free > 0.6 { 0.6 - 0.7 * (free - 0.6) } else { free }
        })
        .collect();
    (xs, ys)
}

fn waveform() -> Figure {
    let (xs, ys) = motion(6.0 * PI);
    let hits: Vec<f64> = (1..xs.len() - 1)
        .filter(|&i| ys[i] > 0.5999 && ys[i] >= ys[i - 1] && ys[i] > ys[i + 1])
        .map(|i| xs[i])
        .collect();
    let line = Line::new(xs, ys, SERIES[0]);
    let impacts = Points::new(hits.clone(), vec![0.6; hits.len()], SERIES[1]).rim(Colour::WHITE);
    let legend = Legend::below().line(line.stroke, "displacement *ξ*(*τ*)").points(&impacts, "impact").patch(
        vibroimpact_plot::ClassStyle {
            colour: Colour::GREY.alpha(0.12),
            hatch: Some(Hatch::new(Pattern::Rising, Colour::GREY)),
        },
        "stop at *δ*",
    );
    let ticks = (0..=3).map(|k| {
        let text = if k == 0 { "0".into() } else { format!("{}π", 2 * k) };
        Tick::new(TAU * f64::from(k), text)
    });
    let panel = Panel::new(
        FigureAxis::new("dimensionless time *τ*").range(0.0, 6.0 * PI).ticks(ticks),
        FigureAxis::new("*ξ*").range(-1.6, 0.9),
    )
    .with(HLine::new(0.0, Stroke::new(Colour::GREY).width(1.2).dash(Dash::Dotted)))
    .with(Wall::new(0.6, TextSide::Above))
    .with(line)
    .with(impacts);
    Figure::new(panel).size(680.0, 360.0).legend(legend)
}

fn basin() -> Result<Figure, Box<dyn Error>> {
    let labels = ["1/1", "2/1", "1/2", "inf/1", "chaotic", "undecided"];
    let n: u16 = 400;
    let mut classes = Vec::with_capacity(usize::from(n) * usize::from(n));
    for j in 0..n {
        for i in 0..n {
            let (x, y) = (f64::from(i) / 200.0 - 1.0, f64::from(j) / 100.0 - 2.0);
            let swirl = (3.0 * x.hypot(y / 2.0) + y.atan2(2.0 * x) + (4.0 * x * y).sin()).sin();
            classes.push(match swirl {
                s if x > 0.72 && y > 1.3 && s > 0.0 => 4,
                s if s > 0.75 => 3,
                s if s > 0.2 => 1,
                s if s > -0.6 => 0,
                s if s > -0.98 => 2,
                _ => 5,
            });
        }
    }
    let palette: Vec<Colour> = labels.iter().map(|l| class_style(l).colour).collect();
    let grid = (usize::from(n), usize::from(n));
    let raster = Raster::centred((-1.0, 1.0), (-2.0, 2.0), grid, classes, palette)?;
    let fixed = Points::new([0.12], [-0.35], Colour::BLACK).size(13.0).rim(Colour::WHITE);
    let mut legend = Legend::below();
    for label in labels {
        // a raster shows fills without hatches, so its legend has none either
        let style = vibroimpact_plot::ClassStyle { hatch: None, ..class_style(label) };
        legend = legend.patch(style, legend_text(label));
    }
    legend = legend.points(&fixed, "fixed point");
    let panel = Panel::new(
        FigureAxis::new("displacement *ξ*_0").range(-1.0, 1.0),
        FigureAxis::new("velocity *ξ*_0′").range(-2.0, 2.0),
    )
    .with(raster)
    .with(fixed)
    .with(Text::new(0.12, -0.35, "1/1").shift(24.0, 14.0));
    Ok(Figure::new(panel).size(680.0, 560.0).legend(legend))
}

fn map() -> Figure {
    let labels = [
        "0",
        "1/1",
        "2/1",
        "3/1",
        "4/1",
        "6/1",
        "1/2",
        "1/3",
        "1/5",
        "2/2",
        "3/2",
        "2/3",
        "inf/1",
        "chaotic",
        "stuck",
        "undecided",
    ];
    let mut cells = Rects::new(labels.map(class_style).to_vec());
    let (nx, ny) = (33, 41);
    for j in 0..ny {
        for i in 0..nx {
            let (x, y) = (0.4 + 0.05 * f64::from(i), 0.125 * f64::from(j));
            let band = 5.2 - 2.6 * (x - 0.4) + 0.9 * (5.0 * x).sin() - y;
            let class = match band {
                b if b < -1.2 => 0,
                b if b < -0.4 && x > 1.2 => 6,
                b if b < -0.8 && x > 0.8 => 7,
                b if b < -0.6 => 8,
                b if b < 0.8 => 1,
                b if b < 1.2 && x > 1.3 => 9,
                b if b < 1.9 => 2,
                b if b < 2.3 && x < 0.9 => 10,
                b if b < 2.8 => 3,
                b if b < 3.3 => 4,
                b if b < 3.8 => 5,
                b if b < 4.1 => 11,
                b if b < 4.5 => 13,
                b if b < 5.2 => 12,
                _ => 14,
            };
            let second = (i * 7 + j * 11) % 23 == 0;
            let classes = if second { vec![class, 6] } else { vec![class] };
            let classes = if (i, j) == (20, 4) || (i, j) == (21, 4) { vec![15] } else { classes };
            cells.cell((x - 0.025, x + 0.025), (y - 0.0625, y + 0.0625), &classes);
        }
    }
    let curve = |shift: f64| -> (Vec<f64>, Vec<f64>) {
        (0..200)
            .map(|k| 0.4 + 1.6 * f64::from(k) / 199.0)
            .map(|x| (x, 5.2 - 2.6 * (x - 0.4) + 0.9 * (5.0 * x).sin() - shift))
            .unzip()
    };
    let (gx, gy) = curve(-0.75);
    let grazing = Line::new(gx, gy, Colour::BLACK).dash(Dash::Dashed);
    let outline = Stroke::new(Colour::BLACK).width(2.0);
    let (mut ox, mut oy) = curve(0.8);
    let (bx, by) = curve(1.9);
    ox.extend(bx.iter().rev());
    oy.extend(by.iter().rev());
    let region = FilledRegion::polygon(ox.into_iter().zip(oy).collect::<Vec<_>>()).outline(outline);
    let mut panel = Panel::new(
        FigureAxis::new("frequency ratio 1/*β*").range(0.375, 2.025),
        FigureAxis::new("clearance *δ*").range(-0.0625, 5.0625),
    )
    .with(cells)
    .with(region)
    .with(grazing.clone());
    let places = [
        ("N", 0.62, 4.3),
        ("P", 0.85, 3.2),
        ("Q", 1.1, 2.0),
        ("R", 1.35, 1.6),
        ("S", 1.6, 2.6),
        ("T", 0.55, 1.4),
        ("U", 1.85, 0.4),
    ];
    let points = Points::new(places.map(|p| p.1), places.map(|p| p.2), Colour::BLACK).size(10.0).rim(Colour::WHITE);
    panel.add(points.clone());
    for (name, x, y) in places {
        panel.add(Text::new(x, y, format!("*{name}*")).shift(15.0, 15.0));
    }
    let mut legend = Legend::below();
    for label in labels {
        legend = legend.patch(class_style(label), legend_text(label));
    }
    legend =
        legend.line(grazing.stroke, "grazing").entry(Key::Outline(outline), "2/1 of 1971").points(&points, "*N* … *U*");
    Figure::new(panel).size(680.0, 620.0).legend(legend)
}

fn panels() -> Figure {
    let (xs, ys) = motion(4.0 * PI);
    let vs: Vec<f64> = ys.windows(2).zip(xs.windows(2)).map(|(y, x)| (y[1] - y[0]) / (x[1] - x[0])).collect();
    let time = Panel::new(FigureAxis::new("*τ*").range(0.0, 4.0 * PI), FigureAxis::new("*ξ*").range(-1.6, 0.9))
        .caption("**(a)** waveform")
        .with(Wall::new(0.6, TextSide::Above))
        .with(Line::new(xs, ys.clone(), SERIES[0]));
    let phase = Panel::new(FigureAxis::new("*ξ*").range(-1.6, 0.9), FigureAxis::new("*ξ*′"))
        .caption("**(b)** phase plane")
        .with(Wall::new(0.6, TextSide::Right))
        .with(Line::new(ys, vs, SERIES[1]).width(2.0));
    let legend = Legend::right()
        .title("motion 2/1")
        .line(Stroke::new(SERIES[0]), "displacement")
        .line(Stroke::new(SERIES[1]).width(2.0), "orbit");
    Figure::grid(2, vec![time, phase]).size(1360.0, 420.0).title("*β* = 0.8, *δ* = 0.6").legend(legend)
}

fn impacts() -> Figure {
    let numbers: Vec<f64> = (1..=40).map(f64::from).collect();
    let geometric: Vec<f64> = numbers.iter().map(|k| 2.0 * 0.7f64.powf(*k)).collect();
    let steady: Vec<f64> = numbers.iter().map(|k| 0.3 + 1.2 * (-k / 6.0).exp()).collect();
    let wild: Vec<f64> = numbers.iter().map(|k| 0.05 + ((k * 12.9898).sin() * 43_758.545).fract().abs()).collect();
    let series = [
        (geometric, Shape::Circle, true, "chatter, *ε* = 0.7"),
        (steady, Shape::Square, false, "1/1"),
        (wild, Shape::TriangleUp, true, "chaotic"),
    ];
    let mut panel = Panel::new(
        FigureAxis::new("impact number *k*"),
        FigureAxis::new("interval *τ*_{*k*+1} − *τ*_{*k*}").log10().grid(),
    );
    let mut legend = Legend::right();
    for (i, (ys, shape, filled, name)) in series.into_iter().enumerate() {
        let mut points = Points::new(numbers.clone(), ys, SERIES[i]).shape(shape);
        points.style.filled = filled;
        legend = legend.points(&points, name);
        panel.add(points);
    }
    panel.add(VLine::new(20.0, Stroke::new(Colour::GREY).width(1.5).dash(Dash::DashDot)));
    Figure::new(panel).size(680.0, 400.0).legend(legend)
}
