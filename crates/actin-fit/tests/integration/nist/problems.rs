use super::dual::{Dual, variables};
use actin_fit::{Data, Mat, Model, Observations};
use std::f64::consts::PI;

#[derive(Clone, Debug, Default)]
pub(crate) struct Problem {
    pub(crate) name: String,
    pub(crate) starts: Vec<Vec<f64>>,
    /// Measured linearisations and evaluations from each start.
    pub(crate) work: Vec<[usize; 2]>,
    pub(crate) parameters: Vec<f64>,
    pub(crate) errors: Vec<f64>,
    pub(crate) sum_of_squares: f64,
    rows: Vec<Vec<f64>>,
}

pub(crate) fn all() -> Vec<Problem> {
    read(include_str!("problems.txt"))
}

pub(crate) fn read(text: &str) -> Vec<Problem> {
    let mut problems: Vec<Problem> = Vec::new();
    for line in text.lines() {
        let mut words = line.split_whitespace();
        let first = words.next().unwrap_or("#");
        let numbers = |words: std::str::SplitWhitespace<'_>| -> Vec<f64> {
            words.map(|w| w.parse().unwrap()).collect()
        };
        match (first, problems.last_mut()) {
            ("#", _) => {}
            ("problem", _) => problems.push(Problem {
                name: words.next().unwrap().to_owned(),
                ..Problem::default()
            }),
            ("start", Some(problem)) => problem.starts.push(numbers(words)),
            ("work", Some(problem)) => {
                let counts = words.map(|word| word.parse().unwrap());
                let counts: Vec<usize> = counts.collect();
                problem.work.push(counts.try_into().unwrap());
            }
            ("certified", Some(problem)) => problem.parameters = numbers(words),
            ("errors", Some(problem)) => problem.errors = numbers(words),
            ("sum", Some(problem)) => problem.sum_of_squares = numbers(words)[0],
            (_, problem) => problem.unwrap().rows.push(numbers(line.split_whitespace())),
        }
    }
    problems
}

impl Problem {
    pub(crate) fn data(&self) -> Data {
        // The response is the logarithm of the first column.
        let response = |row: &Vec<f64>| match self.name.as_str() {
            "Nelson" => row[0].ln(),
            _ => row[0],
        };
        let y: Vec<f64> = self.rows.iter().map(response).collect();
        let x: Vec<f64> = self.rows.iter().flat_map(|row| row[1..].to_vec()).collect();
        let width = self.rows[0].len() - 1;
        Data::from_rows(width, &x, Observations::new(&y).unwrap()).unwrap()
    }

    /// Columns of a model that is linear in the predictors, after a constant.
    pub(crate) fn design(&self) -> Mat<f64> {
        let entry = |i: usize, j: usize| if j == 0 { 1.0 } else { self.rows[i][j] };
        Mat::from_fn(self.rows.len(), self.parameters.len(), entry)
    }
}

impl Model for Problem {
    fn parameters(&self) -> usize {
        self.parameters.len()
    }

    fn value(&self, x: &[f64], p: &[f64]) -> f64 {
        function(&self.name, x, &variables(p)).value
    }

    fn gradient(&self, x: &[f64], p: &[f64], gradient: &mut [f64]) {
        let slopes = function(&self.name, x, &variables(p)).slopes;
        gradient.copy_from_slice(&slopes[..p.len()]);
    }
}

fn function(name: &str, row: &[f64], b: &[Dual]) -> Dual {
    let x = row[0];
    let one = Dual::from(1.0);
    match name {
        "Bennett5" => b[0] * (b[1] + x).power(-(one / b[2])),
        "BoxBOD" | "Misra1a" => b[0] * (1.0 - (-b[1] * x).exp()),
        "Chwirut1" | "Chwirut2" => (-b[0] * x).exp() / (b[1] + b[2] * x),
        "DanWood" => b[0] * Dual::from(x).power(b[1]),
        "ENSO" => oscillations(x, b),
        "Eckerle4" => b[0] / b[1] * (-0.5 * ((x - b[2]) / b[1]).squared()).exp(),
        "Gauss1" | "Gauss2" | "Gauss3" => {
            let peak = |b: &[Dual]| b[0] * (-((x - b[1]) / b[2]).squared()).exp();
            b[0] * (-b[1] * x).exp() + peak(&b[2..5]) + peak(&b[5..8])
        }
        "Hahn1" | "Thurber" => {
            let above = b[0] + x * (b[1] + x * (b[2] + x * b[3]));
            above / (1.0 + x * (b[4] + x * (b[5] + x * b[6])))
        }
        "Kirby2" => (b[0] + x * (b[1] + x * b[2])) / (1.0 + x * (b[3] + x * b[4])),
        "Lanczos1" | "Lanczos2" | "Lanczos3" => {
            let decay = |b: &[Dual]| b[0] * (-b[1] * x).exp();
            decay(&b[..2]) + decay(&b[2..4]) + decay(&b[4..])
        }
        "MGH09" => b[0] * (x * x + x * b[1]) / (x * x + x * b[2] + b[3]),
        "MGH10" => b[0] * (b[1] / (x + b[2])).exp(),
        "MGH17" => b[0] + b[1] * (-b[3] * x).exp() + b[2] * (-b[4] * x).exp(),
        "Misra1b" => b[0] * (1.0 - one / (1.0 + b[1] * x / 2.0).squared()),
        "Misra1c" => b[0] * (1.0 - (1.0 + 2.0 * b[1] * x).power(Dual::from(-0.5))),
        "Misra1d" => b[0] * b[1] * x / (1.0 + b[1] * x),
        "Nelson" => b[0] - b[1] * x * (-b[2] * row[1]).exp(),
        "Rat42" => b[0] / (1.0 + (b[1] - b[2] * x).exp()),
        "Rat43" => b[0] * (1.0 + (b[1] - b[2] * x).exp()).power(-(one / b[3])),
        "Roszman1" => b[0] - b[1] * x - (b[2] / (x - b[3])).atan() / PI,
        _ => panic!("no function for {name}"),
    }
}

fn oscillations(x: f64, b: &[Dual]) -> Dual {
    let wave = |period: Dual, a: Dual, c: Dual| {
        let angle = 2.0 * PI * x / period;
        a * angle.cos() + c * angle.sin()
    };
    b[0] + wave(Dual::from(12.0), b[1], b[2]) + wave(b[3], b[4], b[5]) + wave(b[6], b[7], b[8])
}
