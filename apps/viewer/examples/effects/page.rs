//! The page's text.

use trigon_scene::Effect;

/// What stands above the tables.
pub(crate) const INTRODUCTION: &str = "# Effects

Every effect is off until a scene and its settings call for it. An effect that is off costs nothing: no attribute, texture,
pass, ray or byte (test `off_means_zero`). The tables below take each effect away from an image that has it, so that you see
what it adds and what it costs. Every effect that a plan can list has at least one row.

The one pipeline of all materials holds the code of every effect. That of soft shadows added 0.8 % to the instructions of a frame
without shadows, 0.1 % with sharp shadow maps and 0.5 % with sharp shadow rays (the scene crate of 1f648f64 against that of 9dfb180d
over the same rasterizer, one warm frame of 960×540 pixels with a knot of 17,500 triangles above a floor, callgrind, AVX2, one thread).

Images are timed at 480×300 pixels without anti-aliasing, on one thread, with everything warm. All images of a scene are
drawn in turn, 15 times over, so that a slow moment of the machine affects all of them alike. Two effects that leave the same
image behind share its time. A time is the median, with the quartiles in parentheses. A cost is the median of the 15 ratios; where
their quartiles lie on both sides of 1, or the median is within 2 % of it, there is no measurable difference. Instructions, where
the table has them, are those of one warm frame (callgrind, AVX2) and hardly vary.

This page is written by

    cargo run --release -p trigon-viewer --no-default-features --example effects -- docs --instructions

and `trigon-viewer FILE --explain=time` measures any model in the same way.

## What nobody could see

An effect in a file that nobody could see is off, too, with the reason (`--explain` tells it). Leaving it out changes no
byte of any output (test `leaving_out_what_nobody_sees_changes_no_byte`):

- a texture that a factor of 0 multiplies: a black base colour, no highlight, no emission, an occlusion strength of 0;
- vertex colours that are white, or that a black base colour multiplies;
- blending with an alpha of 1 everywhere: by the factor, the texture and the vertex colours. Depth and ids still show what lies
  behind such a surface, unless outputs of blended surfaces are requested, and it casts no shadow;
- a mask whose cutoff no alpha is below;
- lamps whose intensity or colour is 0, or whose range or cone ends before any lit surface in view (with mirrors or glass: before any
  lit surface). Bounds are those of the current pose;
- maps of light on unlit surfaces.

A normal map of scale 0 is flat by definition: the surface shows its own normals.

## Through a fisheye lens

Rays find the surfaces, and all effects of light are the same: the samples of such an image run the pipelines of any other. Edges of
faces, wireframes, lines, points and marks have a width on the plane of an image, and are left out; the plan lists edges as off, and
`Omission::all` (in Python a `TrigonWarning`) names the rest.

## How shadow maps keep off their own surface

A shadow map holds the depth at the centre of each texel. A point on the same plane can lie up to √2 texels away from
that centre, and would shadow itself. So points are moved along the surface normal before they are looked up. A plane
needs √2 · sin θ texels, where θ is the angle between the normal and the direction in which the map looks. A quarter of
a texel is added for curvature and rounding. No bias is added to depths. A shadow therefore begins at most 1.7 texels
away from what casts it. Where interpolated normals lean away from a coarse mesh's triangles by more than about 10°,
points are moved farther along them, so that they rise above the triangle by what its plane needs. Shadow rays need none
of this.

## Ambient occlusion that pixels share

`--ambient-occlusion-sampling=shared`, and the presets `draft` and `standard`, cast a sixteenth of the rays at each pixel of an image of half
the width and height. The 16 pixels around each one have cast all of them together, and their mean is what the samples of
the image read. Neighbours count as far as they lie on the plane of the surface, so that neither objects nor the sides of an
edge mix. A sample whose surface the small image does not show casts a quarter of the rays itself. The image depends on nothing but the
scene, the camera and the settings. Drafts in a window are drawn so; the image at rest has the rays that the settings ask for. If
that takes more than a tenth of a second, a preview comes first: the image at rest, but with 64 shared rays. With the preset `high` and
ambient occlusion the viewer draws its built-in scene of 1280×800 pixels in 0.68 to 0.80 s by these and in 9.6 to 10.1 s by those of every
sample (whole runs of three each in turn, two threads).

    cargo bench -p trigon-study --bench occlusion

times it beside rays at every sample (480×300 pixels, one sample each, one thread, AVX-512, 15 rounds in turn, medians), and compares both
with 1,024 rays in f64 at every pixel. Errors are root mean squares, relative to those of 16 rays at every sample:

| rays | exhibition | error | boxes | error | knots | error |
|---|--:|--:|--:|--:|--:|--:|
| none | 9.2 ms | | 1.9 ms | | 3.0 ms | |
| 16 at every sample | +1876 % | 1 | +2646 % | 1 | +1821 % | 1 |
| 64 at every sample | +7281 % | 0.45 | +10526 % | 0.34 | +6910 % | 0.60 |
| 16 shared | +91 % | 1.45 | +156 % | 1.96 | +136 % | 1.48 |
| 32 shared (`draft`) | +114 % | 1.24 | +183 % | 1.53 | +159 % | 1.18 |
| 64 shared (`standard`) | +177 % | 1.06 | +265 % | 1.33 | +218 % | 0.98 |

Other runs had +94, +95 and +99 % for 16 shared rays in the exhibition. They take 54 million instructions beside the 84 million of the image
(callgrind, AVX2): 14 for the 22,679 rays, 11 for the boxes in which eight neighbours start, 4 for the means, 6 for reading them, and the rest for
the second pass over the surfaces.

At every sample, 16 rays are 1,415,792 in the exhibition, where they leave 180 ms: 7.9 million a second on one thread. Within five times the image's
time it would have to be 31 million.

What remains of the error lies where occlusion is narrower than the five pixels over which the mean is taken.

## Soft shadows

A lamp with a radius casts a soft shadow. Lights have one (`Light::radius`, *Radius* in the editor), and `--light-radius` gives it to lamps
that have none, since glTF's have none. A point or spot light is a sphere of so many metres; a directional light is a disc of so many metres at a
distance of one: 0.00465 for the sun. Where no lamp has a radius nothing of this is prepared, and no byte changes. The light itself still comes
from the middle of the lamp: only how much of it is visible is averaged over its disc.

- **By rays** (`--shadows=rays`). `--shadow-rays` of them go to points all over the disc: at every sample, or shared by pixels
  (`--shadow-sampling=shared`, the preset `high`) in the same way as [those of ambient occlusion](#ambient-occlusion-that-pixels-share), for each of up to
  16 lamps. Where the shared mean changes too fast for its reach of five pixels, it would blur an edge, and the samples cast a quarter of
  the rays themselves. So sharp shadows stay sharp; near penumbras shared means can be a little off.
- **By maps** (`--shadows=maps`), as percentage-closer soft shadows: 32 texels are searched for casters, and as many compared over a disc as
  wide as the penumbra of the caster that is nearest to the surface. A pyramid of the nearest depths bounds the search, so that surfaces with nothing before them
  pay a few look-ups. Only casters within the cone from the point to the lamp count, and texels are compared with the
  plane of the surface. Behind a straight edge that is exact; behind casters at several distances, each of which hides a part of the
  lamp, it is an estimate. A map knows only what its lamp's middle sees: what a high roof hides from it casts no shadow at its foot.

The image depends on nothing but the scene, the camera and the settings.

    cargo bench -p trigon-study --bench occlusion -- shadows

times all of them under a sun of two sizes (480×300 pixels, one sample each, one thread, AVX-512, 15 rounds in turn, medians; costs are above
the sharp shadows of the same kind), and compares them with 1,024 rays in f64 at every pixel. Errors are root mean squares over all lit
surfaces, of white in that light, where 1 is the light of a surface that faces the sun:

| radius | shadows | exhibition | error | boxes | error | knots | error |
|---|---|--:|--:|--:|--:|--:|--:|
| 0.05 | sharp, by rays | 22.5 ms | | 4.3 ms | | 6.0 ms | |
| | 16 rays at every sample | +499 % | 0.010 | +805 % | 0.002 | +621 % | 0.013 |
| | 64 rays at every sample | +1995 % | 0.009 | +3375 % | 0.001 | +2723 % | 0.011 |
| | 16 shared | +35 % | 0.031 | +3 % | 0.013 | +119 % | 0.027 |
| | 64 shared (`high`) | +174 % | 0.028 | +61 % | 0.013 | +426 % | 0.018 |
| | sharp, by maps of 2048 | 18.9 ms | | 4.9 ms | | 5.0 ms | |
| | maps of 2048 | +75 % | 0.031 | +117 % | 0.006 | +114 % | 0.014 |
| 0.2 | sharp, by rays | 27.9 ms | | 6.2 ms | | 6.2 ms | |
| | 16 rays at every sample | +575 % | 0.013 | +743 % | 0.002 | +774 % | 0.019 |
| | 64 rays at every sample | +2093 % | 0.010 | +3000 % | 0.001 | +3084 % | 0.012 |
| | 16 shared | +52 % | 0.039 | +18 % | 0.011 | +160 % | 0.048 |
| | 64 shared (`high`) | +239 % | 0.030 | +68 % | 0.007 | +539 % | 0.028 |
| | sharp, by maps of 2048 | 13.1 ms | | 5.2 ms | | 4.5 ms | |
| | maps of 2048 | +155 % | 0.032 | +296 % | 0.007 | +222 % | 0.028 |

Maps are about as accurate as 64 shared rays here, and faster in two of the three scenes. What 64 rays at every sample leave lies on curved
surfaces, and hardly depends on their number.

## What metals reflect

Lit by lamps alone, a metal is black outside its highlights. Metals therefore reflect a studio if the scene has no
environment and no ambient light of its own, unless it is drawn with nothing but its own lights (`Lighting::Scene`). The
studio is a grey room that is bright above, darker below the horizon, and turns with the world's up axis. It has no
colour, so a metal shows its own, and a white one stays white. The studio replaces the ambient light in proportion to
how metallic a point is. Dielectrics keep every byte, and vectors of eight pixels without any metal look nothing up.
`--metal-reflection=ambient` turns it off. Note that glTF's default material is a metal.

The table of the studio takes 5 kB and is made when the first metal is drawn. Without a metal in view there is none.

## How lamps are exposed

Modelling programs export lamps in lux and candela: a lamp of 1000 W from Blender has 54,350 cd, and a white surface
seven metres away has 330 times the white of a display. A light meter therefore reads the light that arrives at the
model, and dims or brightens the scene's lamps if a display could not show what they light. That is so if even middle
grey (18 %) would be clipped in the key light, or white would be darker than a tenth of middle grey. Lamps in between
keep every byte.

- The key light is what nine tenths of the lit surface do not exceed. Every object counts the same, however large it is, and every
  area within an object. So neither a wide floor nor the shade of a lamp decides.
- Exposed, a white surface in the key light has 0.7 of the display's white, and about 0.8 with the ambient light that is added.
- Ambient light that is added, environments and unlit surfaces stay as they are. An environment replaces
  brightening, but not dimming.
- Emitted light stays as it is, too. glTF defines it in nits, but programs that export lamps in candela write
  emission beside them as a plain factor. Dimmed with such lamps, glowing surfaces would be black.
- The reading is a property of the scene. It does not depend on the camera, the image or the pose of an animation: turntables,
  animations and all other series of a model have one exposure. Shadows and reflections are no part of it.

`--explain` tells the reading and the exposure, `--check` notes it, and `--json` has it as `light`. `--exposure=0` turns the meter off, as
does any other exposure. `--light-intensity` makes a metered image brighter or darker. If most of a model is white or black anyway, a
warning says how much of it, and what to do (`Scene::exposure_warning`).

## What is behind glass

A surface with transmission shows what is behind it, without any flag. For each shaded sample of it, a ray goes on to
the next surface. The search tree of these rays holds all triangles of the scene. A scene without such a surface in view
has neither. The ray meets up to 8 surfaces, and 4 in drafts; `--bounces=N` sets another number and traces mirrors, too;
`--bounces=0` draws glass as if it were opaque, and a warning says so.

- Exact, up to the rounding of f32: refraction by interpolated normals, total reflection, volumes within volumes, absorption along the
  way of the ray (Beer's law), masks and culled faces behind glass, and the background.
- Without a volume (KHR_materials_volume with a thickness) a surface is thin, and bends nothing. A volume whose surface has open edges
  stands for a plate with parallel faces, as thick as the material says: it absorbs, and bends nothing either. So does blended glass.
- Schlick's approximation of Fresnel's law. What glass reflects comes from lamps, the environment or ambient light; with
  `--bounces` also from other surfaces, at the first surface.
- Surfaces behind glass show their diffuse colour in the light of the scene, without highlights and normal maps. Blended surfaces, lines
  and points behind it are missing. Glass casts the shadow of an opaque surface.
- Rough glass: each sample follows one of 16 microfacets, chosen by its place in a square of four by four samples. With 4×4 samples per
  pixel all of them are averaged; with fewer, rough glass is grainy. Only the first surface scatters.
- A transparent background counts as the default one, unless there is an environment.
";

/// What stands below them.
pub(crate) const OTHERS: &str = "
## Over a pipeline written by hand

The bench `overhead` draws a knot of 70,000 triangles at 1920×1080 through the scene renderer, and through pipelines, each of
which is written for one class of material. It compares the images: at most 5 pixels differ, by 1 of 255. Instructions of one
warm frame, in millions (callgrind, AVX2, one thread):

| image | by hand | by the scene renderer | more | share of the scene's frame |
|---|--:|--:|--:|--:|
| one colour, unlit | 60.4 | 61.2 | 1.4 % | 1.3 % |
| a texture, and light at the vertices | 154.5 | 169.2 | 9.5 % | 8.7 % |
| one colour, and Lambert's light per pixel | 81.8 | 117.8 | 44.0 % | 30.6 % |
| a texture, a normal map, Lambert's light per pixel, and a shadow map, drawn in the first frame | 235.4 | 290.5 | 23.4 % | 19.0 % |
| textures of base colour, normals, metalness and roughness, GGX per pixel in the light of one lamp | 251.9 | 300.4 | 19.3 % | 16.2 % |

The scene compiles a single pipeline for all materials, and reads at run time what a pipeline by hand knows when it is compiled.
By function, in millions (the knot fills 99,410 groups of eight pixels):

| image | pixels, without filtering | by hand | filtering of textures, both | vertices | by hand |
|---|--:|--:|--:|--:|--:|
| a texture, and light at the vertices | 47.1 | 35.9 | 65.5 | 3.9 | 2.1 |
| one colour, light per pixel | 62.9 | 28.5 | 0 | 3.0 | 2.2 |
| texture, normal map, shadow map | 137.6 | 86.3 | 91.4 | 6.2 | 4.1 |
| base colour, normals, metalness and roughness | 121.7 | 76.9 | 117.3 | 6.2 | 4.1 |

The difference lies nearly all in the pixels. In the image with the shadow map, the scene takes 52.2 in the loop over visible
pixels and the albedo, 34.9 in the function for light per pixel, 18.6 for the normal map, 26.2 for the shadow map and 5.7 for the
planes of triangles; by hand all of it is one function. By hand it is known that only front sides are seen, that Lambert's light needs
no direction to the eye, that normals have a length, and that the lamp's light is parallel.

The pipelines by hand are an upper bound: they also leave out what any scene needs (mirrored nodes, degenerate normals, other lamps).
A second compiled pipeline for the commonest material, base colour, normals, metalness and roughness in the light of one lamp, could
gain 14.9 % of the frame in its pixels at most. It was to be made for 15 %, and would double the largest function of the renderer, so
it is not done. The lit image without textures has the largest share to gain.

To count the instructions of a frame:

    cargo bench -p trigon-scene --bench overhead -- scene textured 50
    program=$(ls -t target/release/deps/overhead-* | grep -v '\\.d$' | head -n 1)
    valgrind --tool=callgrind --demangle=no --toggle-collect='*shortest*' \"$program\" hand textured 1

## Beside another renderer

The same meshes, lamps and cameras, drawn by Mitsuba 3.9.1: a physically based renderer whose surfaces, lamps and shadows share
no code with trigon's. It takes 1,024 samples per pixel with a box filter, trigon 16. Differences are in linear light, relative to the mean light of
the image: over all pixels that show a surface, and over those whose neighbours show the same one. `docs/testing.md` has the
command.

| image | RMSE | within surfaces | greatest within | why they differ |
|---|--:|--:|--:|---|
| Lambert's law, a ball in the sun | 0.14 % | 0.009 % | 0.35 % | f32; at outlines 16 samples against 1,024. The greatest difference is where light grazes the ball: Mitsuba also tests on which side of the triangle itself the sun is |
| GGX, a white metal of roughness 0.4 | 0.14 % | 0.12 % | 2.3 % | Mitsuba treats masking and shadowing of microfacets as independent; glTF, and so trigon, correlates them by height. It shows at grazing light |
| GGX on a black dielectric of roughness 0.5 | 3.7 % | 3.8 % | 23 % | Fresnel's equations against Schlick's approximation, which glTF prescribes; and masking, as above |
| a normal map on a floor in the sun | 0.47 % | 0.45 % | 34 % | Mitsuba's error. At the brightest places it is 0.5 % below the value that follows from the definition, and trigon within 0.002 % (filtered bytes, normalized, times the light; six pixels in f64). Six of Mitsuba's pixels at the far edge differ from their neighbours; without them the greatest difference is 0.67 % |
| a point light above a floor | 0.028 % | 0.001 % | 0.016 % | f32 |
| a spot light with a rim of an eighth of a degree | 2.2 % | 2.2 % | 70 % | the rim, with 16 samples per pixel |
| a spot light that fades from 17° to 34° | 60 % | 61 % | 414 % | Mitsuba fades linearly in the angle, KHR_lights_punctual with the square of a cosine. Inside the fading zone's inner cone they differ by 0.002 % at most; outside its outer cone both are dark |
| a shadow of a knot, by rays | 0.51 % | 0.50 % | 15 % | the shadow's edge, with 16 samples per pixel |
| the same by maps of 2,048 texels | 1.1 % | 1.1 % | 42 % | the shadow's edge: filtered texels |
";

/// What an effect costs.
pub(crate) struct Cost {
    /// The quarters of the milliseconds without it.
    pub(crate) without: [f64; 3],
    /// The quarters of those with it.
    pub(crate) with: [f64; 3],
    /// The quarters of the ratios of both in the same round.
    pub(crate) ratio: [f64; 3],
    /// The ratio of the instructions, if they were counted.
    pub(crate) instructions: Option<f64>,
}

/// The head of a table.
pub(crate) fn head(is_counted: bool) -> String {
    let [name, line] = if is_counted { [" instructions |", "--:|"] } else { ["", ""] };
    format!(
        "| effect | without | with | why | ms without | ms with | cost |{name}\n|---|---|---|---|--:|--:|--:|{line}\n"
    )
}

/// A line of a table.
pub(crate) fn row(effect: Effect, [off, on]: &[String; 2], reason: &str, cost: &Cost) -> String {
    let milliseconds = |[low, median, high]: [f64; 3]| format!("{median:.2} ({low:.2}–{high:.2})");
    let [less, more] = [cost.without, cost.with].map(milliseconds);
    let counted = cost.instructions.map_or_else(String::new, |ratio| format!(" {} |", percent(ratio)));
    let said = said(cost.ratio);
    format!(
        "| {effect} | ![](effects/{off}) | ![](effects/{on}) | {reason} | {less} | {more} | {said} |{counted}\n"
    )
}

/// The cost in words.
fn said([low, median, high]: [f64; 3]) -> String {
    const NOISE: f64 = 0.02;
    let is_noise = (low <= 1.0 && high >= 1.0) || (median - 1.0).abs() <= NOISE;
    if is_noise { "no measurable difference".to_owned() } else { percent(median) }
}

/// By how much something grew. A change that rounds to nothing has no sign.
fn percent(ratio: f64) -> String {
    let percent = ((ratio - 1.0) * 100.0).round();
    if percent == 0.0 { "0 %".to_owned() } else { format!("{percent:+.0} %") }
}
