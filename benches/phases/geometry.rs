//! The phases from a mesh to the two problems.

use criterion::Criterion;
use roundel::field::{FieldProblem, OrientationField, curvature_constraints};
use roundel::map::{Combing, CutGraph, SeamlessOptions, SeamlessProblem};
use roundel::mesh::curvature::curvature;
use roundel::mesh::{TriangleMesh, shape, subdivide};
use roundel::{Options, Result, solve};

use crate::case::TRIANGLES;

pub fn bench(criterion: &mut Criterion, threads: usize) {
    let mesh = shape::by_name("genus-2", TRIANGLES).expect("there is such a shape");
    let mut group = criterion.benchmark_group(format!("geometry, {threads} threads"));
    #[cfg(feature = "mesh-io")]
    for format in ["obj", "off", "ply"] {
        let file =
            std::env::temp_dir().join(format!("roundel-bench-{}.{format}", std::process::id()));
        roundel::mesh::io::write(&file, &mesh).expect("a folder for temporary files");
        group.bench_function(format!("read {format}"), |b| {
            b.iter(|| roundel::mesh::io::read(&file))
        });
        // A file that cannot be removed stays in the folder for temporary files.
        let _ = std::fs::remove_file(&file);
    }
    group.bench_function("connectivity", |b| {
        b.iter(|| TriangleMesh::new(mesh.vertices().to_vec(), mesh.triangles().to_vec()))
    });
    group.bench_function("subdivide", |b| b.iter(|| subdivide(&mesh)));
    group.bench_function("curvature", |b| b.iter(|| curvature(&mesh)));
    let given = curvature_constraints(&mesh, 0.1).expect("a tenth is a fraction");
    group.bench_function("field: assemble", |b| {
        b.iter(|| FieldProblem::new(&mesh, &given))
    });
    let field = field(&mesh).expect("the shape has a field");
    group.bench_function("field: indices", |b| b.iter(|| field.vertex_indices(&mesh)));
    let cones = field.irregular_vertices(&mesh);
    group.bench_function("map: cut", |b| b.iter(|| CutGraph::new(&mesh, &cones)));
    let cut = CutGraph::new(&mesh, &cones).expect("cones are vertices");
    group.bench_function("map: comb", |b| {
        b.iter(|| Combing::new(&mesh, &field, &cut))
    });
    // This includes seams, sectors and the energy, which cannot be measured separately.
    group.bench_function("map: assemble, all of it", |b| {
        b.iter(|| SeamlessProblem::new(&mesh, &field, &SeamlessOptions { quads: 1000 }))
    });
    group.finish();
}

fn field(mesh: &TriangleMesh) -> Result<OrientationField> {
    let problem = FieldProblem::new(mesh, &curvature_constraints(mesh, 0.1)?)?;
    let solution = solve(problem.problem(), &Options::orientation_field())?;
    problem.field(mesh, &solution)
}
