//! The time of every phase by itself, on procedural shapes: `cargo bench --bench phases -- PHASE`.
//!
//! | file | phases |
//! | --- | --- |
//! | `geometry` | reading, curvature, assembly of the field, cut, comb, assembly of the map |
//! | `before` | validation and elimination, relaxation |
//! | `factors` | orderings, supernodal and simplicial factors, solves |
//! | `rounding` | updates after one rounding: fixing, Gauss-Seidel, conjugate gradients |
//! | `after` | the continuous unknowns of an incumbent, expansion, verification |

mod after;
mod before;
mod case;
mod factors;
mod geometry;
mod rounding;

use criterion::{Criterion, criterion_group, criterion_main};

fn phases(criterion: &mut Criterion) {
    geometry::bench(criterion);
    for case in case::cases().expect("procedural shapes are valid") {
        before::bench(criterion, &case);
        factors::bench(criterion, &case);
        rounding::bench(criterion, &case);
        after::bench(criterion, &case);
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10);
    targets = phases
}
criterion_main!(benches);
