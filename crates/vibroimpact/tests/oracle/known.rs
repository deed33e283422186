//! Answers that once were wrong, by number, with the evidence. A fixed one stays.
//!
//! Errors are in units in the last place times condition, of which 8 are allowed.

use super::case::Case;
use super::referee::verdict;
use vibroimpact::Side;
use vibroimpact::flight::SearchLimits;

const PLAIN: Case = Case::from_stop(1.0, 0.0, 0.0, 0.0);

/// Number, evidence, question.
const KNOWN: [(u32, &str, Case); 23] = [
    (
        1,
        "slow exponential taken at zeta - root in place of zeta: 4e7 units",
        Case { zeta: 1.000_000_000_000_000_4, ..Case::from_stop(11.0, 0.0, -0.003, 0.131) },
    ),
    (
        2,
        "the same: 5e6 units",
        Case {
            zeta: 1.000_000_000_000_000_7,
            ..Case::from_stop(22.832_179_258_206_96, -0.95, -0.020_607_722_232_459_227, 4.035_589_872_551_516)
        },
    ),
    (
        3,
        "contact 7e-9 before the common period passed over: cut by 2e-17, the data leave 1e-15 open",
        Case::from_stop(4.0, 2.0, -1e-8, 4.0),
    ),
    (
        4,
        "the same, cut by three times what the data leave open",
        Case::from_stop(2.0, 3.356_197_899_743_711_4, -1.864_620_670_127_268_5e-8, 4.715_649_495_675_31),
    ),
    (
        5,
        "at rest on the stop, and again after the common period, where it touches: called an impact 7e-9 before",
        Case::from_stop(2.0, 3.0, 0.0, 2.0),
    ),
    (6, "the same, 4e-8 before", Case::from_stop(0.5, 1.0, 0.0, 1.25)),
    (7, "1 - cos s, near a whole period, by subtraction: 751 units", Case::from_stop(2.0, 3.0, -1e-6, 4.712)),
    (8, "the same: 45 units", Case::from_stop(4.0, 3.0, -1e-6, 1.56)),
    (9, "forced part just beyond the series, by subtraction: 289 units", Case::from_stop(60.0, 0.0, -0.001, 0.25)),
    (
        10,
        "the same: 25 units",
        Case {
            zeta: 1.590_135_662_051_585_6e-6,
            ..Case::from_stop(2.0, 0.166_519_679_435_086_05, -0.000_693_817_758_815_448_7, 0.031_031_370_967_206_89)
        },
    ),
    (11, "the same: 38 units", Case { zeta: 1e-6, ..Case::from_stop(99.0, 0.6, -0.000_13, 0.47) }),
    (
        12,
        "the same, critical: 1e3 units",
        Case {
            zeta: 1.0,
            second: Some(1.429_658_778_312_489_7),
            ..Case::from_stop(0.019_550_040_131_305_96, 0.000_705_761_493_565_849_1, -4.537_357_209_412_683_6e-8, 0.0)
        },
    ),
    (
        13,
        "the same, overdamped: 78 units",
        Case { beta: 0.999, zeta: 1.7, gap: 0.0, x: -1.6e-4, v: -4e-4, phase: 0.08, ..PLAIN },
    ),
    (
        14,
        "the same, from a free start: 132 units",
        Case { beta: 96.0, gap: 6e-7, x: 0.0, v: 1e-6, phase: 0.01, ..PLAIN },
    ),
    (
        15,
        "slow forcing, whose angle is summed from s and (beta - 1) s: 15 units",
        Case {
            beta: 0.014_204_691_363_253_696,
            gap: 0.020_446_737_743_995_413,
            x: 0.0,
            v: -9.224_165_470_410_731e-6,
            phase: 3.137_032_593_868_28,
            ..PLAIN
        },
    ),
    (
        16,
        "the same, damped: 19 units",
        Case {
            zeta: 0.483_880_976_071_969_1,
            ..Case::from_stop(0.013_286_337_034_621_53, 0.0, -1.086_956_054_3, 3.369_418_842_415_110_6)
        },
    ),
    (
        17,
        "the same, released: 23 units",
        Case {
            zeta: 0.202_412_439_144_067_15,
            release: Some(Side::Upper),
            ..Case::from_stop(0.011_318_066_176_309_411, 0.000_218_153_505_305_501_58, 0.0, 3.141_374_500_082_757_3)
        },
    ),
    (
        18,
        "fast forcing, late, critical: 25 units",
        Case {
            zeta: 1.0,
            beta: 72.599_071_951_347_1,
            gap: 0.0,
            x: -4.131_052_840_300_709,
            v: 0.162_170_944_405_169_35,
            phase: 4.237_862_973_175_321_5,
            ..PLAIN
        },
    ),
    (
        19,
        "a whole period with fast forcing: 279 units",
        Case::from_stop(
            77.031_922_693_940_33,
            4.861_487_810_861_354,
            -0.004_255_433_662_855_019,
            1.459_999_740_450_391,
        ),
    ),
    (20, "the same: 30 units", Case::from_stop(77.0, 3.8, -0.001_2, 4.7)),
    (
        21,
        "called grazing 1.5e-13 short of the stop, where the data leave 5e-14 open",
        Case {
            gap: 31.866_765_244_753_896,
            x: 2.635_628_167_072_158_4,
            v: -2.646_810_140_931_791_5,
            phase: 3.929_223_039_918_494,
            ..PLAIN
        },
    ),
    (
        22,
        "6e-18 short of the stop, called an impact; the data leave 3e-15 open",
        Case::from_stop(0.999_999_999, -0.359_293_555_710_933_35, -0.375_448_225_949_595_76, 2.557_809_988_985_079),
    ),
    (
        23,
        "cut by 2e-17, passed over; the data leave 1e-14 open",
        Case::from_stop(1.000_001, 3.739_687_767_629_756, -0.971_075_487_655_166_5, 1.280_182_663_554_539_5),
    ),
];

#[test]
fn what_once_was_wrong() {
    let mut wrong = Vec::new();
    for (number, why, case) in &KNOWN {
        let verdict = verdict(case, SearchLimits::default(), 700.0);
        println!("{number:>3} {why}: {verdict:?}");
        if let Err(fault) = verdict {
            wrong.push(format!("{number}: {why}\n  {case}\n  {fault:?}"));
        }
    }
    assert!(wrong.is_empty(), "{} of {} wrong again:\n{}", wrong.len(), KNOWN.len(), wrong.join("\n"));
}
