//! Frames that are redrawn after changes, beside frames of another rasterizer that draws everything.

mod model;

use self::model::{Delta, Model, QUADS, Told, delta};
use crate::{
    BlendMode, Cancel, Culling, Draw, DrawChange, ExecuteSettings, FaceEdges, Output, Pass, Rasterizer, Stats,
};
use model::{View, up_to_tiles, view};
use proptest::prelude::*;
use trigon_math::{Vec3, Vec4};

fn models(surfaces: [BlendMode; 2]) -> Vec<Model> {
    let [front, back] =
        [(surfaces[0], 0.0), (surfaces[1], 0.5)].map(|(blend_mode, shift)| Model::sheet(blend_mode, shift));
    // No part of it is ever changed.
    let still = Model::sheet(BlendMode::Opaque, 0.2);
    vec![front, back, Model { triangles: still.triangles[..7].to_vec(), ..still }]
}

/// One change of a model: which of the deltas, and how many of its vertices move.
type Step = (prop::sample::Index, Option<prop::sample::Index>);

/// Steps of which most are repeated a few times, as in a drag, so that what is kept for that is used.
fn steps() -> impl Strategy<Value = Vec<Step>> {
    let part = prop_oneof![3 => Just(None), 1 => any::<prop::sample::Index>().prop_map(Some)];
    let repeated = (any::<prop::sample::Index>(), prop::collection::vec(part, 1..6));
    prop::collection::vec(repeated, 1..4).prop_map(|steps| {
        let several = |(delta, parts): (_, Vec<Option<_>>)| parts.into_iter().map(move |part| (delta, part));
        steps.into_iter().flat_map(several).collect()
    })
}

/// Redraws after each change of the models. Both kinds of draws come in the pass's order, and
/// the lines last.
fn check(
    view: &View,
    mut models: Vec<Model>,
    (deltas, steps): (&[Delta], &[Step]),
) -> Result<(), TestCaseError> {
    let mut rasterizer = Rasterizer::new(view.settings).expect("a level that there is");
    let mut target = view.target();
    rasterizer.redraw(&view.pass(&models), &mut target, None);
    for (delta, part) in steps {
        let delta = delta.get(deltas);
        let count = part.map_or(delta.moved.len(), |part| part.index(delta.moved.len() + 1));
        let Told { vertices, reshaped, recolored, resized } =
            delta.apply_part(&mut models[delta.model], count);
        let (vertices, mut changes) = (vertices.as_slice(), [DrawChange::default(); 6]);
        changes[delta.model] = DrawChange { vertices, reshaped: &reshaped, recolored: &recolored };
        if delta.model == 0 {
            // The lines and the points have its vertices.
            changes[4..].fill(DrawChange { vertices, ..DrawChange::default() });
            if view.has_points {
                changes[5].reshaped = &resized;
            }
        }
        let redraw = rasterizer.redraw(&view.pass(&models), &mut target, Some(&changes));
        let counts = view.counts(&models);
        prop_assert!(up_to_tiles(&redraw.stats) == counts, "the counts of a whole image after {delta:?}");
        let fresh = view.fresh(&models);
        prop_assert!(target.srgb8() == fresh.srgb8(), "bytes after {delta:?}");
        prop_assert!(target.unorm8() == fresh.unorm8(), "linear bytes after {delta:?}");
        prop_assert!(target.linear() == fresh.linear(), "light after {delta:?}");
        prop_assert!(target.depth() == fresh.depth(), "depth after {delta:?}");
        prop_assert!(target.objects() == fresh.objects(), "objects after {delta:?}");
        prop_assert!(target.faces() == fresh.faces(), "faces after {delta:?}");
        prop_assert!(target.triangles() == fresh.triangles(), "triangles after {delta:?}");
    }
    Ok(())
}

fn blend_mode() -> impl Strategy<Value = BlendMode> {
    prop::sample::select(vec![
        BlendMode::Opaque,
        BlendMode::Masked,
        BlendMode::MaskedPerSample,
        BlendMode::Overlay,
        BlendMode::Translucent,
    ])
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    #[test]
    fn an_image_that_follows_is_a_fresh_one(
        view in view(),
        surfaces in [blend_mode(), blend_mode()],
        deltas in prop::collection::vec(delta(), 1..4),
        steps in steps(),
    ) {
        check(&view, models(surfaces), (&deltas, &steps))?;
    }

    /// Opaque surfaces with points, one sample to a pixel: this is what can be kept while vertices are dragged.
    #[test]
    fn an_image_of_a_drag_is_a_fresh_one(
        size in [1_u32..300, 1_u32..200],
        edges in prop_oneof![Just(None), (0.5_f32..5.0).prop_map(Some)],
        background in 1..3_usize,
        has_points: bool,
        has_marks: bool,
        has_depth: bool,
        settings in view().prop_map(|view| view.settings),
        deltas in prop::collection::vec(delta(), 1..3),
        steps in steps(),
        has_overlay: bool,
    ) {
        let outputs = match has_depth {
            true => vec![Output::Srgb8, Output::Depth, Output::Object, Output::Face, Output::Triangle],
            false => vec![Output::Unorm8],
        };
        let view = View {
            size, samples: [1, 1], outputs, edges, has_marks, has_lines: false, has_points, background, settings,
        };
        let calm = |delta: Delta| Delta { marked: [Vec::new(), Vec::new()], ..delta };
        let deltas: Vec<Delta> = deltas.into_iter().map(calm).collect();
        let second = if has_overlay { BlendMode::Overlay } else { BlendMode::Opaque };
        check(&view, models([BlendMode::Opaque, second]), (&deltas, &steps))?;
    }
}

fn plain(outputs: &[Output]) -> View {
    View {
        size: [600, 500],
        samples: [1, 1],
        outputs: outputs.to_vec(),
        edges: Some(1.0),
        has_marks: false,
        has_lines: true,
        has_points: true,
        background: 1,
        settings: ExecuteSettings::default(),
    }
}

fn one_vertex() -> Delta {
    Delta {
        model: 0,
        moved: vec![(34, [0.05, 0.0, 0.0, 0.0])],
        painted: Vec::new(),
        turned: Vec::new(),
        marked: [Vec::new(), Vec::new()],
        resized: Vec::new(),
    }
}

/// The share of the target that was drawn again.
fn share(view: &View, parts: &[crate::Rect]) -> f64 {
    let area =
        |part: &crate::Rect| f64::from(part.max[0] - part.min[0]) * f64::from(part.max[1] - part.min[1]);
    parts.iter().map(area).sum::<f64>() / f64::from(view.size[0] * view.size[1])
}

#[test]
fn only_tiles_around_what_moved_are_drawn() {
    let (view, mut models) = (plain(&[Output::Srgb8]), models([BlendMode::Opaque; 2]));
    let mut rasterizer = Rasterizer::default();
    let mut target = view.target();
    let first = rasterizer.redraw(&view.pass(&models), &mut target, None);
    assert_eq!(share(&view, &first.parts), 1.0, "nothing was there");
    let unchanged = [DrawChange::default(); 6];
    let same = rasterizer.redraw(&view.pass(&models), &mut target, Some(&unchanged));
    assert!(same.parts.is_empty(), "nothing differs");
    let Told { vertices, .. } = one_vertex().apply(&mut models[0]);
    let mut changes = unchanged;
    for draw in [0, 4, 5] {
        changes[draw].vertices = &vertices;
    }
    let moved = rasterizer.redraw(&view.pass(&models), &mut target, Some(&changes));
    let drawn = share(&view, &moved.parts);
    assert!(drawn > 0.0 && drawn < 0.3, "four quads of {}: {drawn}", QUADS * QUADS);
    assert!(target.srgb8() == view.fresh(&models).srgb8(), "the bytes of a fresh image");
}

/// From the second time on, the still triangles of a tile are kept; from the third time on, only pixels that may look
/// different are shaded.
#[test]
fn only_pixels_around_what_moves_again_are_shaded() {
    let view = View { has_lines: false, background: 2, ..plain(&[Output::Srgb8]) };
    let mut models = models([BlendMode::Opaque; 2]);
    let mut rasterizer = Rasterizer::default();
    let mut target = view.target();
    rasterizer.redraw(&view.pass(&models), &mut target, None);
    let shaded: Vec<u64> = (0..5)
        .map(|_| {
            let Told { vertices, .. } = one_vertex().apply(&mut models[0]);
            let mut changes = [DrawChange::default(); 6];
            for draw in [0, 4, 5] {
                changes[draw].vertices = &vertices;
            }
            let redraw = rasterizer.redraw(&view.pass(&models), &mut target, Some(&changes));
            assert!(target.srgb8() == view.fresh(&models).srgb8(), "the bytes of a fresh image");
            redraw.stats.pixels_shaded
        })
        .collect();
    assert!(shaded[2..].iter().all(|&again| 3 * again < 2 * shaded[0]), "pixels shaded: {shaded:?}");
}

#[test]
fn only_tiles_around_other_marks_are_drawn() {
    let view = View { has_marks: true, ..plain(&[Output::Srgb8]) };
    let mut models = models([BlendMode::Opaque; 2]);
    let mut rasterizer = Rasterizer::default();
    let mut target = view.target();
    rasterizer.redraw(&view.pass(&models), &mut target, None);
    let before = target.srgb8().map(<[_]>::to_vec);
    let marked = [vec![(44, 3)], vec![(40, 3)]];
    let Told { recolored, .. } = Delta { moved: Vec::new(), marked, ..one_vertex() }.apply(&mut models[0]);
    let mut changes = [DrawChange::default(); 6];
    changes[0].recolored = &recolored;
    let redraw = rasterizer.redraw(&view.pass(&models), &mut target, Some(&changes));
    let drawn = share(&view, &redraw.parts);
    assert!(drawn > 0.0 && drawn < 0.3, "three quads of {}: {drawn}", QUADS * QUADS);
    assert!(target.srgb8() != before.as_deref(), "other marks look different");
    assert!(target.srgb8() == view.fresh(&models).srgb8(), "the bytes of a fresh image");
}

/// Ordinals of a draw without triangles begin where those of the next draw do: a redraw took
/// the changed vertices of the one for those of the other, and asked an empty range for its
/// last triangle.
#[test]
fn draws_without_triangles_broke_the_redraws_look_up_of_draws() {
    let view = plain(&[Output::Srgb8]);
    let mut after = Model::sheet(BlendMode::Opaque, 0.0);
    let (before, behind) = (after.clone(), Model::sheet(BlendMode::Opaque, 0.5));
    let Told { vertices, .. } = one_vertex().apply(&mut after);
    // The changed sheet lies before the third one, which stays as it is.
    for [empty, changed] in [[0, 1], [0, 2], [1, 0], [1, 2], [2, 0], [2, 1]] {
        let record = |sheet| {
            let mut pass = Pass::new();
            pass.edges(FaceEdges { width: 1.0, color: Vec3::X, opacity: 0.7 });
            for draw in 0..3 {
                if draw == empty {
                    pass.triangles(Draw::new(&behind, &[]));
                } else {
                    Model::record(if draw == changed { sheet } else { &behind }, draw, &mut pass);
                }
            }
            pass
        };
        let mut changes = [DrawChange::default(); 3];
        changes[changed as usize].vertices = &vertices;
        let (mut rasterizer, mut target, mut fresh) = (Rasterizer::default(), view.target(), view.target());
        rasterizer.redraw(&record(&before), &mut target, None);
        let redraw = rasterizer.redraw(&record(&after), &mut target, Some(&changes));
        Rasterizer::default().draw(&record(&after), &mut fresh);
        assert!(share(&view, &redraw.parts) < 0.3, "draw {empty} is empty, and {changed} follows");
        assert!(target.srgb8() == fresh.srgb8(), "draw {empty} is empty, and {changed} moves");
    }
}

/// Whatever else the rasterizer has done in between: it tells nothing of the changes.
#[test]
fn after_anything_else_everything_is_drawn() {
    let (view, models) = (plain(&[Output::Srgb8]), models([BlendMode::Opaque; 2]));
    let unchanged = [DrawChange::default(); 6];
    let spoil: [fn(&mut Rasterizer, &View, &[Model]); 4] = [
        |rasterizer, view, models| {
            let _: Stats = rasterizer.draw(&view.pass(models), &mut view.target());
        },
        |rasterizer, view, models| {
            rasterizer.explain_pixel(&view.pass(models), &view.target(), 0, 0);
        },
        |rasterizer, view, models| {
            let cancel = Cancel::default();
            cancel.cancel();
            rasterizer.set_cancel(Some(cancel));
            rasterizer.redraw(&view.pass(models), &mut view.target(), None);
            rasterizer.set_cancel(None);
        },
        |rasterizer, view, models| {
            let other = View { outputs: vec![Output::Srgb8, Output::Depth], ..view.clone() };
            rasterizer.redraw(&view.pass(models), &mut other.target(), None);
        },
    ];
    for (number, spoil) in spoil.into_iter().enumerate() {
        let (mut rasterizer, mut target) = (Rasterizer::default(), view.target());
        rasterizer.redraw(&view.pass(&models), &mut target, None);
        spoil(&mut rasterizer, &view, &models);
        let redraw = rasterizer.redraw(&view.pass(&models), &mut target, Some(&unchanged));
        assert_eq!(share(&view, &redraw.parts), 1.0, "number {number}");
    }
}

/// A triangle that is cut by the near plane and faces away is counted as cut and as culled, but leaves nothing
/// else: its chunk looks like one without it.
#[test]
fn triangles_that_were_cut_and_culled_still_count_after_a_change() {
    let sheet = |shift: f32| {
        let mut sheet = Model::sheet(BlendMode::Opaque, 0.0);
        sheet.vertices[34].0.x += shift;
        // Three corners of its own: one of them behind the eye.
        let corners = [[-0.5, 0.5, 1.0], [0.5, 0.5, 1.0], [0.0, -0.5, -1.0]];
        let first = sheet.vertices.len() as u32;
        sheet.vertices.extend(corners.map(|[x, y, w]| (Vec4::new(x, y, 0.3, w), Vec4::ONE)));
        sheet.triangles.push([first, first + 1, first + 2]);
        sheet
    };
    let view = plain(&[Output::Srgb8]);
    let (before, after) = (sheet(0.0), sheet(0.05));
    fn record(sheet: &Model, culling: Culling) -> Pass<'_> {
        let mut pass = Pass::new();
        pass.triangles(Draw { culling, ..Draw::new(sheet, &sheet.triangles) });
        pass
    }
    let mut clipped = [0, 0];
    for (culling, clipped) in [Culling::Back, Culling::Front].into_iter().zip(&mut clipped) {
        let (mut rasterizer, mut target, mut fresh) = (Rasterizer::default(), view.target(), view.target());
        rasterizer.redraw(&record(&before, culling), &mut target, None);
        let change = DrawChange { vertices: &[34], ..DrawChange::default() };
        let redraw = rasterizer.redraw(&record(&after, culling), &mut target, Some(&[change]));
        let stats = Rasterizer::default().draw(&record(&after, culling), &mut fresh);
        assert_eq!(up_to_tiles(&redraw.stats), up_to_tiles(&stats), "{culling:?}");
        assert!(target.srgb8() == fresh.srgb8(), "{culling:?}");
        *clipped = stats.clipped;
    }
    assert_eq!(clipped, [1, 1], "it is cut, whichever side is drawn");
}
