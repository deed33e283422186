//! Tests of invalid questions: one message, exit code 2, no computation, no file overwritten.

use crate::{Folder, S, refused, vibro};

#[test]
fn bad_questions_are_named() {
    let rest = "--gap 1 --restitution 0.5";
    let grid = "--x -1:0.5:3 --v -1:1:3";
    let sweep = |rest: &str| format!("diagram --restitution 0.5 {rest}");
    let branch = |rest: &str| format!("branch {S} --label 2/1 --vary {rest}");
    let curve = |rest: &str| format!("curve {S} --label 1/1 --kind {rest}");
    let region = |rest: &str| format!("region --label 1/1 {rest}");
    let body = "--mass-kg 1 --stiffness-n-per-m 1 --force-n 1 --frequency-hz 1 --gap-m 1";
    let of_second = "diagram --beta 1 --gap 1 --second-gap 1 --vary restitution --over 0:1:3";
    let both_frequencies = "--beta cannot go together with --vary inverse-beta";
    let rests = format!("curve {S} --label inf/1 --kind fold --vary gap=0:2 --and beta=0.5:1");
    let undamped = "without damping the steady motion without impacts is one of many";
    let no_orbit = "branch --inverse-beta 0.7 --gap 40 --restitution 0.5 --label 1/1 --vary gap --to 41";
    for (line, sentence) in [
        (format!("settle --beta nan {rest}"), "beta = NaN lies outside 1e-15 <= beta <= 1e15"),
        (format!("settle --beta 1e400 {rest}"), "beta = inf"),
        (format!("settle --inverse-beta 0 {rest}"), "1/beta = 0"),
        (format!("settle {rest}"), "exactly one of beta and inverse beta"),
        (format!("settle --beta 1 --inverse-beta 1 {rest}"), "cannot be used with"),
        ("settle --beta 1 --restitution 0.5".into(), "the gap is not given"),
        ("settle --beta 1 --gap 1".into(), "the restitution is not given"),
        (format!("settle --beta 1 {rest} --x 1.5"), "x = 1.5 lies beyond the stop"),
        (format!("settle --beta 1 {rest} --phase=-1e18"), "lies outside -1e15 <= phase <= 1e15"),
        (format!("settle --beta 1 {rest} --second-restitution 1"), "no gap"),
        (format!("settle --beta 1 {rest} --units si"), "physical units"),
        (format!("settle --mass-kg 1 {rest}"), "missing: --stiffness-n-per-m"),
        ("settle --gap 1.5mm --gap-m 0.001 --restitution 0.5".into(), "cannot be used with"),
        (format!("settle {rest} --second-gap 1mm --gaps-m 0.001"), "cannot be used with"),
        (format!("settle --beta 1 {rest} --limit 5"), "--rule paper"),
        (format!("settle --beta 1 {rest} --rule paper --percent 0"), "percent = 0"),
        (format!("settle --beta 1 {rest} --frobnicate"), "unexpected argument"),
        (format!("settle --beta one {rest}"), "invalid value 'one'"),
        (format!("settle --beta= {rest}"), "--beta"),
        (format!("simulate --beta 1 {rest} --csv a.csv --step 0"), "step = 0"),
        (format!("orbit {S} --label -1/1"), "label `-1/1`"),
        (format!("attractors {S} --starts 1000000000000"), "starts = 1000000000000"),
        (format!("attractors {S} --starts 5 --threads 99999"), "99999"),
        (format!("basin {S} --x -1:0.75:1000000000000000000 --v 0:1:3"), "allowed is 1 to 1000000"),
        (format!("basin {S} --x -1:0.75:1000000 --v 0:1:1000000"), "at most 100000000"),
        (format!("basin {S} {grid} --plot figure.eps"), "none of .svg, .png and .pdf"),
        (format!("basin {S} {grid} --plot .png"), "none of .svg, .png and .pdf"),
        (format!("basin {S} {grid} --csv - --json"), "both want stdout"),
        (format!("diagram {S} --vary gap --over 0:1:3"), "--gap cannot go together with --vary gap"),
        (sweep("--beta 1 --vary inverse-beta --over 1:2:3 --gap 1"), both_frequencies),
        (sweep("--inverse-beta 1 --vary gap"), "--over"),
        (sweep("--inverse-beta 1 --vary mass --over 0:1:3"), "invalid value 'mass'"),
        (sweep("--beta 1 --vary damping --over 0:1:3"), "the gap is not given"),
        (sweep("--beta 1 --gap 1 --vary second-gap --over 0:-1:3"), "no room"),
        (sweep("--beta 1 --gap 1 --vary second-restitution --over 0:1:3"), "no gap"),
        (of_second.into(), "that of the second stop is not given"),
        (sweep("--beta 1 --vary gap --over 0:1:3 --transient -1"), "invalid value '-1'"),
        (sweep("--beta 1 --vary gap --over 0:1:3 --starts 5"), "belong to --direction scatter"),
        (sweep("--beta 1 --vary gap --over 0:1:3 --direction sideways"), "invalid value 'sideways'"),
        (format!("lyapunov {S} --impacts -5"), "invalid value '-5'"),
        (format!("lyapunov {S} --points 5"), "--section FILE or --plot FILE"),
        (branch("mass --to 1"), "invalid value 'mass'"),
        (format!("branch {S} --label inf/1 --vary gap --to 1"), "no admissible orbit inf/1 was found"),
        (rests, "a cycle that rests on a stop"),
        (format!("branch {S} --label 0 --vary gap --to 1"), undamped),
        (format!("branch {S} --label 5/4 --vary gap --to 1 --orbit 99"), "there is no orbit 5/4 number 99"),
        (no_orbit.into(), "no admissible orbit 1/1"),
        (branch("gap --to 1 --no-diagram"), "--plot FILE"),
        (branch("gap --to 1 --plot a.png --orbit 0"), "there is no orbit 2/1 number 0"),
        (curve("tori --vary gap=0:1 --and beta=1:2"), "invalid value 'tori'"),
        (curve("torus --vary gap=0:1 --and beta=1:2"), "are curves of machines"),
        (region("--inverse-beta 1:2 --gap 1 --restitution 0.5"), "ranges A:B are given for 1"),
        (region("--inverse-beta 1:2 --gap 1:2 --restitution 0.5:0.6"), "ranges A:B are given for 3"),
        (
            region(&format!("{body} --gap 1 --inverse-beta 1:2 --restitution 0.5:0.6")),
            "--gap cannot go together with a system in physical units",
        ),
        (region("--inverse-beta 1:2 --gap 1:2 --restitution 0.5 --units si"), "--units si needs"),
        (region("--inverse-beta 1:2 --restitution 0.5:0.6"), "the gap is not given"),
        ("frobnicate".into(), "unrecognized subcommand"),
        ("completions tcsh-of-old".into(), "invalid value"),
    ] {
        let folder = Folder::new();
        let complaint = folder.refused(&line);
        assert!(complaint.starts_with("error: ") && complaint.contains(sentence), "{line}: {complaint}");
        assert_eq!(folder.count(), 0, "{line}");
    }
}

/// Everything that is missing is named in one message.
#[test]
fn all_that_is_missing_is_named_at_once() {
    let system = "--beta <B>|--inverse-beta --gap --restitution";
    for (line, named) in [
        ("map", "--restitution --starts --beta --gap A:B:N"),
        ("map --gap 0:1:3", "--restitution --starts --beta"),
        ("response", "--restitution --beta --gap"),
        ("basin", &format!("--x --v {system}")),
        ("basin --x 0:0.5:3 --gap 1", "--v --beta --restitution"),
        ("attractors", &format!("--starts {system}")),
        ("orbit", &format!("--label {system}")),
        ("branch", &format!("--label --vary --to {system}")),
        ("curve", &format!("--label --kind --vary --and {system}")),
        ("region", "--label --restitution --beta --gap"),
        ("diagram --vary gap", "--over --beta --restitution"),
        ("attractors --mass-kg 1", "--starts --stiffness-n-per-m --force-n --frequency-hz --gap-m --restitution"),
        ("map --mass-kg 1", "--starts --stiffness-n-per-m --force-n --frequency-hz --gap-m --restitution"),
        ("settle", "--beta --gap --restitution"),
        ("simulate", "--beta --gap --restitution"),
        ("lyapunov", "--beta --gap --restitution"),
        ("settle --mass-kg 1", "--stiffness-n-per-m --force-n --frequency-hz --gap-m --restitution"),
    ] {
        let complaint = refused(line);
        // the usage names flags that are not missing
        let message = complaint.split("Usage:").next().unwrap();
        for flag in named.split(' ') {
            assert!(message.contains(flag), "{line}: {flag} in {complaint}");
        }
    }
}

/// What new users type instead of the right form, and the hint they get.
#[test]
fn typical_mistakes_get_a_hint() {
    let rest = "--gap 1 --restitution 0.5";
    let machine = "--mass-kg 1 --stiffness-n-per-m 1000 --force-n 1 --restitution 0.5";
    let hertz = "hint: --frequency-hz takes a positive number of hertz; -5 Hz";
    let chain = "settle-many --machine chain --sample lhs:3 --over frequency=1:2 --gap 1";
    Folder::new().refuse([
        ("settle --beta 1.5 --gap 1 --restitution 50%".into(), "hint: write 0.5"),
        (format!("map --beta 1:2 {rest} --starts 3"), "1:2:41 is 41 values"),
        (format!("settle -beta 1 {rest}"), "'--beta'"),
        (format!("settle beta=1 {rest}"), "'--beta=1'"),
        (format!("settle --betta 1 {rest}"), "'--beta'"),
        (format!("settle --beta 1 {rest} --units SI"), "similar value exists: 'si'"),
        (format!("settle {machine} --frequency-hz -5 --gap-m 0.001"), hertz),
        (format!("settle --beta 1 {rest} --csv no/such.csv"), "hint: `mkdir -p"),
        (format!("settle --beta 1 {rest} --plot a.jpg"), "hint: --plot a.svg"),
        ("run no.toml".into(), "hint: a plan is a TOML or JSON file"),
        ("settle --machine chain --restitution 0.9".into(), "--set PATH=VALUE"),
        ("settle --machine chain --units si".into(), "hint: results are in the units of the machine"),
        ("margins --machine chain --x 1".into(), "hint: --q and --qdot"),
        (chain.into(), "has no effect with --machine"),
        (format!("settle {S} --set stop.wall.gap=1"), "--set has no effect without --machine"),
        (format!("branch {S} --label 1/1 --vary gap --to 1 --also beta"), "hint: beta="),
        (format!("attractors {S} --starts 1,000,000"), "hint: write 1000000"),
    ]);
    // values with blanks
    let output = vibro("settle").args(["--restitution", "50 %"]).output().unwrap();
    assert!(String::from_utf8(output.stderr).unwrap().contains("\nhint: write 0.5\n"));
    let minus = vibro("settle --beta 1 --restitution 0.5").args(["--gap", "\u{2212}0.5"]).output().unwrap();
    assert!(minus.status.success());
}

#[test]
fn nothing_asked_is_answered_with_help() {
    assert!(refused("").contains("Usage"));
}
