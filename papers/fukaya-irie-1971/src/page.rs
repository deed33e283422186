//! The report as a page: one file without external parts, for screens of any size and for print.

use crate::claims::{Agreement, Claim, Report, Section};

/// The page.
pub(crate) fn html(report: &Report) -> String {
    let [agrees, partly, differs] = report.counts();
    let mut page = format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"generator\" content=\"fukaya-irie-1971 {}\">\n\
         <title>Fukaya and Irie 1971, reproduced</title>\n<style>\n{}</style>\n</head>\n<body>\n",
        env!("CARGO_PKG_VERSION"),
        include_str!("page.css")
    );
    page.push_str(
        "<h1>On the Transient Oscillation of a Vibro-Impact System, reproduced</h1>\n\
         <p>K. Fukaya, T. Irie, <cite>On the Transient Oscillation of a Vibro-Impact System</cite>, Bulletin of the Faculty of \
         Engineering, Hokkaido University 62 (1971) 31&ndash;39, \
         <a href=\"https://hdl.handle.net/2115/41063\">hdl.handle.net/2115/41063</a>. Each figure is computed anew; beside it \
         stands what the paper says of it, what was found, and whether the two agree.</p>\n",
    );
    if report.quick {
        page.push_str("<p><strong>A quick run: coarse grids and few starts. Not to be cited.</strong></p>\n");
    }
    page.push_str(&format!(
        "<ul class=\"counts\"><li class=\"agrees\"><span class=\"verdict\">{agrees} agree</span></li>\
         <li class=\"partly\"><span class=\"verdict\">{partly} agree in part</span></li>\
         <li class=\"differs\"><span class=\"verdict\">{differs} differ</span></li></ul>\n<nav><ol>\n"
    ));
    for (k, section) in report.sections.iter().enumerate() {
        page.push_str(&format!("<li><a href=\"#s{k}\">{}</a> {}</li>\n", pretty(section.title), marks(section)));
    }
    page.push_str("</ol></nav>\n");
    for (k, section) in report.sections.iter().enumerate() {
        part(&mut page, k, section);
    }
    page.push_str(
        "<footer><p>Restitution 0.5 and no damping throughout. What the paper says is given in our words, from its text; \
         its drawings were not measured. A verdict m/n was confirmed by Newton&rsquo;s method with stable multipliers, \
         &ldquo;no impact&rdquo; includes motions whose impacts grow ever gentler without end. The numbers come from the run that \
         wrote this page; the same program writes the same bytes.</p></footer>\n</body>\n</html>\n",
    );
    page
}

fn part(page: &mut String, k: usize, section: &Section) {
    let pictured = if section.svg.is_some() { " class=\"pictured\"" } else { "" };
    page.push_str(&format!("<section id=\"s{k}\"{pictured}>\n<h2>{}</h2>\n", pretty(section.title)));
    let files: Vec<String> = section.files.iter().map(|file| format!("<a href=\"{file}\">{file}</a>")).collect();
    if let Some(svg) = &section.svg {
        page.push_str(&format!(
            "<div class=\"body\">\n<figure><div class=\"sheet\" role=\"img\" aria-label=\"{}\">{}</div>\n\
             <figcaption>{}<br>{}</figcaption></figure>\n",
            escape(section.title),
            scalable(svg),
            pretty(&section.caption),
            files.join(" &middot; ")
        ));
    } else {
        page.push_str(&format!(
            "<p class=\"soft\">{}<br>{}</p>\n<div class=\"body\">\n",
            pretty(&section.caption),
            files.join(" &middot; ")
        ));
    }
    page.push_str("<div class=\"claims\">\n");
    for claim in &section.claims {
        row(page, claim);
    }
    page.push_str("</div></div>\n</section>\n");
}

fn row(page: &mut String, claim: &Claim) {
    let word = claim.verdict.word();
    let from = if claim.figure.starts_with('(') {
        format!("Conclusion {}", claim.figure)
    } else {
        format!("Fig. {}", claim.figure)
    };
    page.push_str(&format!(
        "<div class=\"claim {word}\"><p class=\"verdict\">{} {word} <span class=\"soft\">&middot; {from}</span></p>\n\
         <p class=\"says\">The paper: {}.</p>\n<p>Found: {}.</p></div>\n",
        sign(claim.verdict),
        pretty(&claim.says),
        pretty(&claim.found)
    ));
}

/// A sign for the verdict that is legible without colour.
const fn sign(verdict: Agreement) -> &'static str {
    match verdict {
        Agreement::Agrees => "&#10003;",
        Agreement::Partly => "&asymp;",
        Agreement::Differs => "&ne;",
    }
}

fn marks(section: &Section) -> String {
    section
        .claims
        .iter()
        .map(|claim| {
            format!(
                "<span class=\"{0}\"><span class=\"verdict\" title=\"{0}\">{1}</span></span>",
                claim.verdict.word(),
                sign(claim.verdict)
            )
        })
        .collect::<Vec<_>>()
        .join(" ")
}

/// The SVG without its size in pixels, which the page sets.
fn scalable(svg: &str) -> String {
    let Some((head, rest)) = svg.split_once('>') else {
        return svg.to_owned();
    };
    let kept: Vec<&str> =
        head.split(' ').filter(|word| !word.starts_with("width=") && !word.starts_with("height=")).collect();
    format!("{}>{rest}", kept.join(" "))
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Replaces names of quantities by their symbols.
fn pretty(text: &str) -> String {
    let mut out = escape(text);
    for (name, letter) in [
        ("1/beta", "1/<i class=\"v\">&beta;</i>"),
        ("delta", "<i class=\"v\">&delta;</i>"),
        ("-eps", "&minus;<i class=\"v\">&epsilon;</i>"),
        ("xi0", "<i class=\"v\">&xi;</i><sub>0</sub>"),
        ("u0", "<i class=\"v\">u</i><sub>0</sub>"),
        ("|f|", "|<i class=\"v\">f</i>|"),
        ("+-", "&plusmn;"),
        ("&gt;=", "&ge;"),
        ("&lt;=", "&le;"),
        ("inf/", "&infin;/"),
        (" -", " &minus;"),
    ] {
        out = out.replace(name, letter);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_is_escaped_and_lettered() {
        assert_eq!(pretty("delta <= |f|"), "<i class=\"v\">&delta;</i> &le; |<i class=\"v\">f</i>|");
        let svg =
            scalable("<svg xmlns=\"x\" width=\"680\" height=\"4\" viewBox=\"0 0 680 4\">\n<g width=\"3\"/></svg>");
        assert_eq!(svg, "<svg xmlns=\"x\" viewBox=\"0 0 680 4\">\n<g width=\"3\"/></svg>");
    }
}
