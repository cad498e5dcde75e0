//! Problems of the Statistical Reference Datasets of NIST, against their certified values.
//!
//! Certified are parameters, their standard deviations (15 digits for linear problems, 11 for
//! nonlinear ones) and the residual sum of squares. Digits are lost to the condition of a problem,
//! so each test asks for a few less than were measured.
//!
//! # Source
//! <https://www.itl.nist.gov/div898/strd/>

#![allow(
    clippy::unreadable_literal,
    clippy::inconsistent_digit_grouping,
    reason = "numbers stand as NIST prints them, to be compared by eye"
)]

mod common;

use actin_fit::{
    Bounds, ClosureModel, Data, Fit, LevenbergMarquardt, LinearFit, Mat, Model, Observations,
    Polynomial, Starts, fit_linear,
};
use common::{digits, errors, least_digits};

fn linear_errors(fit: &LinearFit) -> Vec<f64> {
    (0..fit.parameters.len())
        .map(|j| fit.precision.standard_error(j).unwrap())
        .collect()
}

#[rustfmt::skip]
const LONGLEY: [[f64; 7]; 16] = [
    [60323.0, 83.0, 234289.0, 2356.0, 1590.0, 107608.0, 1947.0],
    [61122.0, 88.5, 259426.0, 2325.0, 1456.0, 108632.0, 1948.0],
    [60171.0, 88.2, 258054.0, 3682.0, 1616.0, 109773.0, 1949.0],
    [61187.0, 89.5, 284599.0, 3351.0, 1650.0, 110929.0, 1950.0],
    [63221.0, 96.2, 328975.0, 2099.0, 3099.0, 112075.0, 1951.0],
    [63639.0, 98.1, 346999.0, 1932.0, 3594.0, 113270.0, 1952.0],
    [64989.0, 99.0, 365385.0, 1870.0, 3547.0, 115094.0, 1953.0],
    [63761.0, 100.0, 363112.0, 3578.0, 3350.0, 116219.0, 1954.0],
    [66019.0, 101.2, 397469.0, 2904.0, 3048.0, 117388.0, 1955.0],
    [67857.0, 104.6, 419180.0, 2822.0, 2857.0, 118734.0, 1956.0],
    [68169.0, 108.4, 442769.0, 2936.0, 2798.0, 120445.0, 1957.0],
    [66513.0, 110.8, 444546.0, 4681.0, 2637.0, 121950.0, 1958.0],
    [68655.0, 112.6, 482704.0, 3813.0, 2552.0, 123366.0, 1959.0],
    [69564.0, 114.2, 502601.0, 3931.0, 2514.0, 125368.0, 1960.0],
    [69331.0, 115.7, 518173.0, 4806.0, 2572.0, 127852.0, 1961.0],
    [70551.0, 116.9, 554894.0, 4007.0, 2827.0, 130081.0, 1962.0],
];

/// Six regressors that grow together: normal equations of the raw columns (condition 5e9) lose
/// nearly all digits of the constant.
#[test]
fn longley() {
    let y: Vec<f64> = LONGLEY.iter().map(|row| row[0]).collect();
    let design = Mat::from_fn(16, 7, |i, j| if j == 0 { 1.0 } else { LONGLEY[i][j] });
    let fit = fit_linear(design.as_ref(), &Observations::new(&y).unwrap()).unwrap();
    let certified = [
        -3482258.63459582,
        15.0618722713733,
        -0.0358191792925910,
        -2.02022980381683,
        -1.03322686717359,
        -0.0511041056535807,
        1829.15146461355,
    ];
    let certified_errors = [
        890420.383607373,
        84.9149257747669,
        0.0334910077722432,
        0.488399681651699,
        0.214274163161675,
        0.226073200069370,
        455.478499142212,
    ];
    let got = least_digits(&fit.parameters, &certified);
    let got_errors = least_digits(&linear_errors(&fit), &certified_errors);
    let got_sum = digits(fit.goodness.chi_squared, 836424.055505915);
    println!(
        "Longley {got:.1} {got_errors:.1} {got_sum:.1} condition {:.1e}",
        fit.precision.condition
    );
    assert!(got > 9.0 && got_errors > 9.0 && got_sum > 9.0);
}

const WAMPLER_5: [f64; 21] = [
    7590001.0,
    -20479994.0,
    20480063.0,
    -20479636.0,
    25231365.0,
    -20476094.0,
    20489331.0,
    -20460392.0,
    18417449.0,
    -20413570.0,
    20591111.0,
    -20302844.0,
    18651453.0,
    -20077766.0,
    21059195.0,
    -19666384.0,
    26348481.0,
    -18971402.0,
    22480719.0,
    -17866340.0,
    10958421.0,
];

/// A polynomial of degree 5 under noise of a thousand times its size: coefficients are 1, with
/// errors to 2e7.
#[test]
fn wampler_5() {
    let x = common::places(0.0, 20.0, 21);
    let data = Data::new(&x, Observations::new(&WAMPLER_5).unwrap()).unwrap();
    let fit = Polynomial::new(5).fit(&data).unwrap();
    let certified_errors = [
        21523262.4678170,
        23635517.3469681,
        7793435.24331583,
        1014755.07550350,
        56456.6512170752,
        1123.24854679312,
    ];
    let got = least_digits(&fit.parameters, &[1.0; 6]);
    let got_errors = least_digits(&linear_errors(&fit), &certified_errors);
    println!(
        "Wampler5 {got:.1} {got_errors:.1} condition {:.1e}",
        fit.precision.condition
    );
    assert!(got > 5.0 && got_errors > 9.0);
}

#[rustfmt::skip]
const FILIP: [[f64; 2]; 82] = [
    [-6.860120914, 0.8116], [-4.324130045, 0.9072], [-4.358625055, 0.9052], [-4.358426747, 0.9039],
    [-6.955852379, 0.8053], [-6.661145254, 0.8377], [-6.355462942, 0.8667], [-6.118102026, 0.8809],
    [-7.115148017, 0.7975], [-6.815308569, 0.8162], [-6.519993057, 0.8515], [-6.204119983, 0.8766],
    [-5.853871964, 0.8885], [-6.109523091, 0.8859], [-5.79832982, 0.8959], [-5.482672118, 0.8913],
    [-5.171791386, 0.8959], [-4.851705903, 0.8971], [-4.517126416, 0.9021], [-4.143573228, 0.909],
    [-3.709075441, 0.9139], [-3.499489089, 0.9199], [-6.300769497, 0.8692], [-5.953504836, 0.8872],
    [-5.642065153, 0.89], [-5.031376979, 0.891], [-4.680685696, 0.8977], [-4.329846955, 0.9035],
    [-3.928486195, 0.9078], [-8.56735134, 0.7675], [-8.363211311, 0.7705], [-8.107682739, 0.7713],
    [-7.823908741, 0.7736], [-7.522878745, 0.7775], [-7.218819279, 0.7841], [-6.920818754, 0.7971],
    [-6.628932138, 0.8329], [-6.323946875, 0.8641], [-5.991399828, 0.8804], [-8.781464495, 0.7668],
    [-8.663140179, 0.7633], [-8.473531488, 0.7678], [-8.247337057, 0.7697], [-7.971428747, 0.77],
    [-7.676129393, 0.7749], [-7.352812702, 0.7796], [-7.072065318, 0.7897], [-6.774174009, 0.8131],
    [-6.478861916, 0.8498], [-6.159517513, 0.8741], [-6.835647144, 0.8061], [-6.53165267, 0.846],
    [-6.224098421, 0.8751], [-5.910094889, 0.8856], [-5.598599459, 0.8919], [-5.290645224, 0.8934],
    [-4.974284616, 0.894], [-4.64454848, 0.8957], [-4.290560426, 0.9047], [-3.885055584, 0.9129],
    [-3.408378962, 0.9209], [-3.13200249, 0.9219], [-8.726767166, 0.7739], [-8.66695597, 0.7681],
    [-8.511026475, 0.7665], [-8.165388579, 0.7703], [-7.886056648, 0.7702], [-7.588043762, 0.7761],
    [-7.283412422, 0.7809], [-6.995678626, 0.7961], [-6.691862621, 0.8253], [-6.392544977, 0.8602],
    [-6.067374056, 0.8809], [-6.684029655, 0.8301], [-6.378719832, 0.8664], [-6.065855188, 0.8834],
    [-5.752272167, 0.8898], [-5.132414673, 0.8964], [-4.811352704, 0.8963], [-4.098269308, 0.9074],
    [-3.66174277, 0.9119], [-3.2644011, 0.9228],
];

/// A polynomial of degree 10 on [-8.8, -3.1]: the hardest of the linear problems. Many programs
/// find it of deficient rank.
#[test]
fn filip() {
    let x: Vec<f64> = FILIP.iter().map(|row| row[0]).collect();
    let y: Vec<f64> = FILIP.iter().map(|row| row[1]).collect();
    let data = Data::new(&x, Observations::new(&y).unwrap()).unwrap();
    let fit = Polynomial::new(10).fit(&data).unwrap();
    let certified = [
        -1467.48961422980,
        -2772.17959193342,
        -2316.37108160893,
        -1127.97394098372,
        -354.478233703349,
        -75.1242017393757,
        -10.8753180355343,
        -1.06221498588947,
        -0.0670191154593408,
        -0.00246781078275479,
        -0.0000402962525080404,
    ];
    let certified_errors = [
        298.084530995537,
        559.779865474950,
        466.477572127796,
        227.204274477751,
        71.6478660875927,
        15.2897178747400,
        2.23691159816033,
        0.221624321934227,
        0.0142363763154724,
        0.000535617408889821,
        0.00000896632837373868,
    ];
    let got = least_digits(&fit.parameters, &certified);
    let got_errors = least_digits(&linear_errors(&fit), &certified_errors);
    println!(
        "Filip {got:.1} {got_errors:.1} condition {:.1e}",
        fit.precision.condition
    );
    assert!(got > 5.0 && got_errors > 5.0);
}

/// A nonlinear problem with its certified values.
struct Certified {
    name: &'static str,
    x: &'static [f64],
    y: &'static [f64],
    starts: &'static [&'static [f64]],
    parameters: &'static [f64],
    errors: &'static [f64],
    sum_of_squares: f64,
}

impl Certified {
    fn data(&self) -> Data {
        Data::new(self.x, Observations::new(self.y).unwrap()).unwrap()
    }

    /// Fits from each start alone: the far one and the near one that NIST gives.
    fn assert_met(&self, model: &dyn Model) {
        for start in self.starts {
            let bounds = Bounds::none(start.len());
            let fit = LevenbergMarquardt::default()
                .fit(model, &self.data(), &bounds, &Starts::at(start))
                .unwrap();
            self.assert_meets(&fit);
        }
    }

    fn assert_meets(&self, fit: &Fit) {
        let search = &fit.starts[fit.best];
        let got = least_digits(&fit.parameters, self.parameters);
        let got_errors = least_digits(&errors(fit), self.errors);
        let got_sum = digits(fit.goodness.chi_squared, self.sum_of_squares);
        println!(
            "{} {got:.1} {got_errors:.1} {got_sum:.1} {:?} iterations {} condition {:.1e}",
            self.name, search.ending, search.iterations, fit.precision.condition
        );
        assert!(
            got > 8.0 && got_errors > 7.0 && got_sum > 9.5,
            "{}",
            self.name
        );
    }
}

const SATURATION_X: [f64; 14] = [
    77.6, 114.9, 141.1, 190.8, 239.9, 289.0, 332.8, 378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0,
];

/// `p0 (1 - exp(-p1 x))`.
fn saturation() -> impl Model {
    ClosureModel::new(
        2,
        |x, p| -p[0] * (-p[1] * x[0]).exp_m1(),
        |x, p, gradient| {
            gradient[0] = -(-p[1] * x[0]).exp_m1();
            gradient[1] = p[0] * x[0] * (-p[1] * x[0]).exp();
        },
    )
}

/// Lower difficulty.
#[test]
fn misra_1a() {
    let problem = Certified {
        name: "Misra1a",
        x: &SATURATION_X,
        y: &[
            10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02, 44.82, 50.76, 55.05, 61.01, 66.40,
            75.47, 81.78,
        ],
        starts: &[&[500.0, 1e-4], &[250.0, 5e-4]],
        parameters: &[2.3894212918E+02, 5.5015643181E-04],
        errors: &[2.7070075241E+00, 7.2668688436E-06],
        sum_of_squares: 1.2455138894E-01,
    };
    problem.assert_met(&saturation());
}

/// Higher difficulty. The far start of NIST, (1, 1), leads to a plateau where the exponential is
/// zero, without convergence; the near one and drawn ones within wide bounds do not all.
#[test]
fn box_bod() {
    let problem = Certified {
        name: "BoxBOD",
        x: &[1.0, 2.0, 3.0, 5.0, 7.0, 10.0],
        y: &[109.0, 149.0, 149.0, 191.0, 213.0, 224.0],
        starts: &[&[100.0, 0.75]],
        parameters: &[2.1380940889E+02, 5.4723748542E-01],
        errors: &[1.2354515176E+01, 1.0455993237E-01],
        sum_of_squares: 1.1680088766E+03,
    };
    problem.assert_met(&saturation());
    let bounds = Bounds::new(&[(1.0, 1000.0), (0.01, 5.0)]).unwrap();
    let fit = LevenbergMarquardt::default()
        .fit(
            &saturation(),
            &problem.data(),
            &bounds,
            &Starts::drawn(8, 1),
        )
        .unwrap();
    problem.assert_meets(&fit);
    println!(
        "BoxBOD: {} of 8 drawn starts agree",
        fit.agreeing_starts(1e-6)
    );
}

/// Higher difficulty: a growth curve with a far start.
#[test]
fn rat_43() {
    let problem = Certified {
        name: "Rat43",
        x: &[
            1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.0, 14.0, 15.0,
        ],
        y: &[
            16.08, 33.83, 65.80, 97.20, 191.55, 326.20, 386.87, 520.53, 590.03, 651.92, 724.93,
            699.56, 689.96, 637.56, 717.41,
        ],
        starts: &[&[100.0, 10.0, 1.0, 1.0], &[700.0, 5.0, 0.75, 1.3]],
        parameters: &[
            6.9964151270E+02,
            5.2771253025E+00,
            7.5962938329E-01,
            1.2792483859E+00,
        ],
        errors: &[
            1.6302297817E+01,
            2.0828735829E+00,
            1.9566123451E-01,
            6.8761936385E-01,
        ],
        sum_of_squares: 8.7864049080E+03,
    };
    let model = ClosureModel::new(
        4,
        |x, p| p[0] / (1.0 + (p[1] - p[2] * x[0]).exp()).powf(1.0 / p[3]),
        |x, p, gradient| {
            let e = (p[1] - p[2] * x[0]).exp();
            let shape = (1.0 + e).powf(-1.0 / p[3]);
            let slope = -p[0] * shape * e / (1.0 + e) / p[3];
            gradient[0] = shape;
            gradient[1] = slope;
            gradient[2] = -x[0] * slope;
            gradient[3] = p[0] * shape * e.ln_1p() / (p[3] * p[3]);
        },
    );
    problem.assert_met(&model);
}

/// Higher difficulty: a rational function with a start a hundred times too far.
#[test]
fn mgh_09() {
    let problem = Certified {
        name: "MGH09",
        x: &[
            4.0, 2.0, 1.0, 0.5, 0.25, 0.167, 0.125, 0.1, 0.0833, 0.0714, 0.0625,
        ],
        y: &[
            0.1957, 0.1947, 0.1735, 0.16, 0.0844, 0.0627, 0.0456, 0.0342, 0.0323, 0.0235, 0.0246,
        ],
        starts: &[&[25.0, 39.0, 41.5, 39.0], &[0.25, 0.39, 0.415, 0.39]],
        parameters: &[
            1.9280693458E-01,
            1.9128232873E-01,
            1.2305650693E-01,
            1.3606233068E-01,
        ],
        errors: &[
            1.1435312227E-02,
            1.9633220911E-01,
            8.0842031232E-02,
            9.0025542308E-02,
        ],
        sum_of_squares: 3.0750560385E-04,
    };
    let model = ClosureModel::new(
        4,
        |x, p| p[0] * (x[0] * x[0] + x[0] * p[1]) / (x[0] * x[0] + x[0] * p[2] + p[3]),
        |x, p, gradient| {
            let (above, below) = (x[0] * x[0] + x[0] * p[1], x[0] * x[0] + x[0] * p[2] + p[3]);
            gradient[0] = above / below;
            gradient[1] = p[0] * x[0] / below;
            gradient[2] = -p[0] * above * x[0] / (below * below);
            gradient[3] = -p[0] * above / (below * below);
        },
    );
    problem.assert_met(&model);
}

const THURBER_X: [f64; 37] = [
    -3.067, -2.981, -2.921, -2.912, -2.840, -2.797, -2.702, -2.699, -2.633, -2.481, -2.363, -2.322,
    -1.501, -1.460, -1.274, -1.212, -1.100, -1.046, -0.915, -0.714, -0.566, -0.545, -0.400, -0.309,
    -0.109, -0.103, 0.010, 0.119, 0.377, 0.790, 0.963, 1.006, 1.115, 1.572, 1.841, 2.047, 2.200,
];

const THURBER_Y: [f64; 37] = [
    80.574, 84.248, 87.264, 87.195, 89.076, 89.608, 89.868, 90.101, 92.405, 95.854, 100.696,
    101.060, 401.672, 390.724, 567.534, 635.316, 733.054, 759.087, 894.206, 990.785, 1090.109,
    1080.914, 1122.643, 1178.351, 1260.531, 1273.514, 1288.339, 1327.543, 1353.863, 1414.509,
    1425.208, 1421.384, 1442.962, 1464.350, 1468.705, 1447.894, 1457.628,
];

/// `(p0 + p1 x + p2 x^2 + p3 x^3) / (1 + p4 x + p5 x^2 + p6 x^3)`.
fn cubic_over_cubic() -> impl Model {
    let parts = |x: f64, p: &[f64]| {
        let above = p[0] + x * (p[1] + x * (p[2] + x * p[3]));
        let below = 1.0 + x * (p[4] + x * (p[5] + x * p[6]));
        (above, below)
    };
    ClosureModel::new(
        7,
        move |x, p| {
            let (above, below) = parts(x[0], p);
            above / below
        },
        move |x, p, gradient| {
            let (above, below) = parts(x[0], p);
            let mut power = 1.0;
            for k in 0..4 {
                gradient[k] = power / below;
                if k > 0 {
                    gradient[3 + k] = -above * power / (below * below);
                }
                power *= x[0];
            }
        },
    )
}

/// Higher difficulty: a cubic over a cubic, seven parameters.
#[test]
fn thurber() {
    let problem = Certified {
        name: "Thurber",
        x: &THURBER_X,
        y: &THURBER_Y,
        starts: &[
            &[1000.0, 1000.0, 400.0, 40.0, 0.7, 0.3, 0.03],
            &[1300.0, 1500.0, 500.0, 75.0, 1.0, 0.4, 0.05],
        ],
        parameters: &[
            1.2881396800E+03,
            1.4910792535E+03,
            5.8323836877E+02,
            7.5416644291E+01,
            9.6629502864E-01,
            3.9797285797E-01,
            4.9727297349E-02,
        ],
        errors: &[
            4.6647963344E+00,
            3.9571156086E+01,
            2.8698696102E+01,
            5.5675370270E+00,
            3.1333340687E-02,
            1.4984928198E-02,
            6.5842344623E-03,
        ],
        sum_of_squares: 5.6427082397E+03,
    };
    problem.assert_met(&cubic_over_cubic());
}
