//! The kernel of the `manifold-rust` crate.
//!
//! It has two engines. The fast one perturbs coordinates symbolically (J. Smith, "Towards robust inexact geometric
//! computation", 2009) and needs operands that are manifold and do not cross themselves. The other one computes with
//! rational numbers and winding numbers (Q. Zhou and others, "Mesh arrangements for solid geometry", 2016), many times
//! slower. Which of them is used depends on the operands alone.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::panic::{AssertUnwindSafe, catch_unwind};

use manifold_rust::manifold::Manifold;
use manifold_rust::types::{BooleanEngine, Error, MeshGLP, OpType};
use trigon_math::DVec3;

use super::kernel::{BooleanKernel, KernelFault, PatchTriangle, PatchedTriangles};
use super::operation::BooleanOperation;

type Exchanged = MeshGLP<f64, u32>;

/// Booleans by `manifold-rust`.
pub(super) struct ManifoldKernel;

impl BooleanKernel for ManifoldKernel {
    fn combine(
        &self,
        operands: &[PatchedTriangles],
        operation: BooleanOperation,
    ) -> Result<PatchedTriangles, KernelFault> {
        let count: usize = operands.iter().map(|operand| operand.triangles.len()).sum();
        if count > i32::MAX as usize / 6 {
            return Err(KernelFault::TooLarge);
        }
        // The crate has assertions that no known input violates; a program must not end because of one.
        let result = catch_unwind(AssertUnwindSafe(|| combine(operands, operation)));
        result.unwrap_or(Err(KernelFault::Failed))
    }
}

fn combine(
    operands: &[PatchedTriangles],
    operation: BooleanOperation,
) -> Result<PatchedTriangles, KernelFault> {
    let mut solids = Vec::with_capacity(operands.len());
    for operand in operands {
        let solid = Manifold::from_mesh_glp_robust(&exchanged(operand));
        check(&solid)?;
        solids.push(solid);
    }
    let engine = engine_for(&solids);
    let mut others = solids.into_iter();
    let Some(first) = others.next() else { return Ok(PatchedTriangles::default()) };
    let others: Vec<Manifold> = others.collect();
    let result = match operation {
        BooleanOperation::Union => union(std::iter::once(first).chain(others), engine)?,
        BooleanOperation::Difference => {
            let tools = union(others, engine)?;
            apply(&first, &tools, OpType::Subtract, engine)?
        }
        BooleanOperation::Intersection => {
            others.iter().try_fold(first, |common, other| apply(&common, other, OpType::Intersect, engine))?
        }
    };
    Ok(patched(&result.get_mesh_glp(-1)))
}

fn engine_for(solids: &[Manifold]) -> BooleanEngine {
    let is_clean = |solid: &Manifold| !solid.as_impl().is_soup && !solid.has_self_intersections();
    if solids.iter().all(is_clean) { BooleanEngine::Exact } else { BooleanEngine::Robust }
}

fn check(solid: &Manifold) -> Result<(), KernelFault> {
    match solid.status() {
        Error::NoError => Ok(()),
        Error::NotManifold | Error::NotClosed => Err(KernelFault::NotClosed),
        Error::ResultTooLarge => Err(KernelFault::TooLarge),
        _ => Err(KernelFault::Failed),
    }
}

fn apply(
    a: &Manifold,
    b: &Manifold,
    operation: OpType,
    engine: BooleanEngine,
) -> Result<Manifold, KernelFault> {
    let result = a.boolean_with_engine(b, operation, engine);
    check(&result)?;
    Ok(result)
}

/// The union of many: always the two smallest next, so that none is copied more than a few times. At equal sizes the
/// first ones.
fn union(solids: impl IntoIterator<Item = Manifold>, engine: BooleanEngine) -> Result<Manifold, KernelFault> {
    let mut solids: Vec<Option<Manifold>> = solids.into_iter().map(Some).collect();
    let size = |solid: &Option<Manifold>| solid.as_ref().map_or(0, Manifold::num_tri);
    let mut queue: BinaryHeap<Reverse<(usize, usize)>> =
        solids.iter().enumerate().map(|(number, solid)| Reverse((size(solid), number))).collect();
    while let (Some(Reverse((_, one))), Some(Reverse((_, other)))) = (queue.pop(), queue.pop()) {
        let (a, b) = (solids[one.min(other)].take(), solids[one.max(other)].take());
        let united = a.zip(b).map(|(a, b)| apply(&a, &b, OpType::Add, engine)).transpose()?;
        queue.push(Reverse((size(&united), solids.len())));
        solids.push(united);
    }
    Ok(solids.into_iter().flatten().next_back().unwrap_or_default())
}

fn exchanged(triangles: &PatchedTriangles) -> Exchanged {
    Exchanged {
        num_prop: 3,
        vert_properties: triangles.positions.iter().flat_map(DVec3::to_array).collect(),
        tri_verts: triangles.triangles.iter().flat_map(|triangle| triangle.vertices).collect(),
        face_id: triangles.triangles.iter().map(|triangle| triangle.patch).collect(),
        ..Exchanged::default()
    }
}

fn patched(mesh: &Exchanged) -> PatchedTriangles {
    let (positions, _) = mesh.vert_properties.as_chunks::<3>();
    let (triangles, _) = mesh.tri_verts.as_chunks::<3>();
    let triangle = |(&vertices, &patch)| PatchTriangle { vertices, patch };
    PatchedTriangles {
        positions: positions.iter().map(|&position| position.into()).collect(),
        triangles: triangles.iter().zip(&mesh.face_id).map(triangle).collect(),
    }
}
