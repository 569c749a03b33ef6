//! The time of every phase by itself, on procedural shapes, with one thread and with two:
//! `cargo bench --bench phases -- PHASE`.
//!
//! | file | phases |
//! | --- | --- |
//! | `geometry` | reading, curvature, assembly of the field, cut, comb, assembly of the map |
//! | `before` | validation and elimination, relaxation |
//! | `factors` | orderings, supernodal and simplicial factors, solves |
//! | `rounding` | updates after one rounding: fixing, Gauss-Seidel, conjugate gradients |
//! | `after` | the continuous unknowns of an incumbent, expansion, verification |
//! | `whole` | adaptive rounding of a field, quads from a map, smoothing, and all steps from a mesh to quads |

mod after;
mod before;
mod case;
mod factors;
mod geometry;
mod rounding;
mod whole;

use criterion::{Criterion, criterion_group, criterion_main};
use roundel::monitor::with_threads;

fn phases(criterion: &mut Criterion) {
    for threads in [1, 2] {
        with_threads(threads, || {
            geometry::bench(criterion, threads);
            for case in case::cases(threads).expect("procedural shapes are valid") {
                before::bench(criterion, &case);
                factors::bench(criterion, &case);
                rounding::bench(criterion, &case);
                after::bench(criterion, &case);
            }
            whole::bench(criterion, threads);
        });
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10);
    targets = phases
}
criterion_main!(benches);
