//! Convex quadratic programs in exact integers, by Lemke's method for the linear complementarity problem of
//! their optimality conditions (`w = Mz + q`, `w'z = 0`), with lexicographic ratios, so that it ends.
//!
//! The tableau stays integer (Edmonds 1967, "Systems of distinct representatives and linear algebra"): each
//! entry is a determinant, and all have the last pivot as their denominator. What does not fit 128 bits is
//! given up.

/// `minimise 1/2 y'Hy + g'y` over `Ay >= b`, `y >= 0`.
pub struct Program {
    pub hessian: Vec<Vec<i128>>,
    pub gradient: Vec<i128>,
    pub rows: Vec<Vec<i128>>,
    pub sides: Vec<i128>,
}

#[derive(Debug, PartialEq)]
pub enum Answer {
    /// Numerators of a minimiser, and their denominator.
    Minimiser(Vec<i128>, i128),
    /// There is no point, or the objective falls for ever.
    None,
    TooLarge,
}

impl Program {
    pub fn solve(&self) -> Answer {
        self.lemke().unwrap_or(Answer::TooLarge)
    }

    /// Whether there is a point.
    pub fn is_feasible(&self) -> Option<bool> {
        let n = self.gradient.len();
        let only_rows = Program {
            hessian: vec![vec![0; n]; n],
            gradient: vec![0; n],
            rows: self.rows.clone(),
            sides: self.sides.clone(),
        };
        match only_rows.solve() {
            Answer::Minimiser(..) => Some(true),
            Answer::None => Some(false),
            Answer::TooLarge => None,
        }
    }

    /// Columns: w, z, the artificial unknown, the right side. None where a number is too large.
    fn tableau(&self) -> Vec<Vec<i128>> {
        let (n, m) = (self.gradient.len(), self.rows.len());
        let size = n + m;
        let mut tableau = vec![vec![0; 2 * size + 2]; size];
        for (i, row) in tableau.iter_mut().enumerate() {
            row[i] = 1;
            row[2 * size] = -1;
            if i < n {
                for j in 0..n {
                    row[size + j] = -self.hessian[i][j];
                }
                for k in 0..m {
                    row[size + n + k] = self.rows[k][i];
                }
                row[2 * size + 1] = self.gradient[i];
            } else {
                for j in 0..n {
                    row[size + j] = -self.rows[i - n][j];
                }
                row[2 * size + 1] = -self.sides[i - n];
            }
        }
        tableau
    }

    fn lemke(&self) -> Option<Answer> {
        let n = self.gradient.len();
        let mut tableau = self.tableau();
        let size = tableau.len();
        let (artificial, right) = (2 * size, 2 * size + 1);
        let mut basis: Vec<usize> = (0..size).collect();
        let mut denominator = 1;
        // The last of the least right sides is the least in lexicographic order.
        let worst = (0..size)
            .rev()
            .min_by_key(|&i| tableau[i][right])
            .filter(|&i| tableau[i][right] < 0);
        if let Some(at) = worst {
            tableau[at].iter_mut().for_each(|v| *v = -*v);
            denominator = pivot(&mut tableau, at, artificial, denominator)?;
            let mut entering = size + basis[at];
            basis[at] = artificial;
            loop {
                let Some(at) = least_ratio(&tableau, &basis, entering)? else {
                    return Some(Answer::None);
                };
                denominator = pivot(&mut tableau, at, entering, denominator)?;
                let leaving = std::mem::replace(&mut basis[at], entering);
                if leaving == artificial {
                    break;
                }
                entering = (leaving + size) % (2 * size);
            }
        }
        let mut point = vec![0; n];
        for (row, &variable) in tableau.iter().zip(&basis) {
            if (size..size + n).contains(&variable) {
                point[variable - size] = row[right];
            }
        }
        Some(Answer::Minimiser(point, denominator))
    }
}

/// Makes column `entering` a unit column. Returns the new denominator.
fn pivot(tableau: &mut [Vec<i128>], at: usize, entering: usize, old: i128) -> Option<i128> {
    let own = tableau[at].clone();
    let new = own[entering];
    for (i, row) in tableau.iter_mut().enumerate() {
        if i == at {
            continue;
        }
        let factor = row[entering];
        for (v, o) in row.iter_mut().zip(&own) {
            *v = v.checked_mul(new)?.checked_sub(factor.checked_mul(*o)?)? / old;
        }
    }
    Some(new)
}

/// The row of the least ratio in lexicographic order; that of the artificial unknown before others.
fn least_ratio(tableau: &[Vec<i128>], basis: &[usize], entering: usize) -> Option<Option<usize>> {
    let size = tableau.len();
    let right = 2 * size + 1;
    let mut best: Option<usize> = None;
    for i in 0..size {
        let pivot = tableau[i][entering];
        if pivot <= 0 {
            continue;
        }
        let Some(b) = best else {
            best = Some(i);
            continue;
        };
        let other = tableau[b][entering];
        for column in std::iter::once(right).chain(0..size) {
            let own = tableau[i][column].checked_mul(other)?;
            let least = tableau[b][column].checked_mul(pivot)?;
            if own == least {
                if column == right && basis[b] == 2 * size {
                    break;
                }
                if column == right && basis[i] == 2 * size {
                    best = Some(i);
                    break;
                }
                continue;
            }
            if own < least {
                best = Some(i);
            }
            break;
        }
    }
    Some(best)
}

#[test]
fn the_exact_programs_have_known_answers() {
    let program = |sides: &[i128], rows: &[[i128; 2]]| Program {
        hessian: vec![vec![2, 0], vec![0, 0]],
        gradient: vec![-2, 1],
        rows: rows.iter().map(|row| row.to_vec()).collect(),
        sides: sides.to_vec(),
    };
    // (x - 1)^2 + y with 3x + y = 1 is least at x = 1/3, y = 0.
    let at = program(&[1, -1], &[[3, 1], [-3, -1]]).solve();
    let Answer::Minimiser(point, denominator) = at else {
        panic!("{at:?}");
    };
    assert_eq!((3 * point[0], point[1]), (denominator, 0));
    let contradictory = program(&[1, 0], &[[3, 1], [-3, -1]]);
    assert_eq!(contradictory.is_feasible(), Some(false));
    let falling = Program {
        gradient: vec![0, -1],
        ..program(&[-5], &[[1, 1]])
    };
    assert_eq!(falling.is_feasible(), Some(true));
    assert_eq!(falling.solve(), Answer::None);
}
