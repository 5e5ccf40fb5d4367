//! Every example of options and commands in F3D's user documentation (03-OPTIONS,
//! 05-ANIMATIONS, 06-CONFIGURATION_FILE, 07-COMMANDS, 08-PARSING and what other pages show),
//! one row each: what trigon does with it, held by its effect on the picture, on the output
//! or on the exit code.

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};

use Expected::{Changes, Exit, Keeps, Refused, Says, Shows, Warned, Writes};

/// What an example does.
#[derive(Clone, Copy, Debug)]
enum Expected {
    /// Same: the picture differs from the one without it, of the same file.
    Changes,
    /// Same: the picture is that without it, because it names the default, or what F3D's flag
    /// turns on is always on.
    Keeps,
    /// Same: the picture is that of these flags, which differs from the one without.
    Shows(&'static str),
    /// Same: standard output holds this.
    Says(&'static str),
    /// Same: it writes this file.
    Writes(&'static str),
    /// Same: it ends with this code, and says this.
    Exit(i32, &'static str),
    /// A flag of graphics cards and plugins: does nothing, with a warning that names it.
    Warned,
    /// Ends with 2 and this reason.
    Refused(&'static str),
}

/// An example: where it stands, the model that it is tried on, its words (words with spaces
/// in quotes), and what it does.
type Row = (&'static str, &'static str, &'static str, Expected);

const NO_MODEL: &str = "";
/// A textured quad in metal and roughness, over it a translucent one.
const QUAD: &str = "quad.gltf";
/// A slide of 3 m in 1 s.
const SLIDE: &str = "slide.gltf";
/// Three sides of a box.
const BOX: &str = "box.obj";
/// Points without faces.
const DOTS: &str = "dots.ply";

#[rustfmt::skip]
const OPTIONS: &[Row] = &[
    // 01-QUICKSTART, and "Application Options" of 03-OPTIONS.
    ("quickstart: output", BOX, "--output=img.png", Writes("img.png")),
    ("quickstart: help", NO_MODEL, "--help", Says("--output")),
    ("input", NO_MODEL, "--input=box.obj --output=img.png", Writes("img.png")),
    ("input: a folder", NO_MODEL, "folder --output={model}.png", Writes("inside.png")),
    ("output", BOX, "--output=out/img.png", Exit(1, "the folder out does not exist")),
    ("output: -", BOX, "--output=-", Says("PNG")),
    ("no-background", BOX, "--no-background", Changes),
    ("no-background=false", BOX, "--no-background=false", Keeps),
    ("-h", NO_MODEL, "-h", Says("--resolution")),
    ("version", NO_MODEL, "--version", Says("trigon-viewer ")),
    ("list-readers", NO_MODEL, "--list-readers", Says(".gltf")),
    ("force-reader", BOX, "--force-reader=OBJ", Keeps),
    ("force-reader: another", BOX, "--force-reader=STL --output=o.png", Exit(1, "nothing to draw")),
    ("list-bindings", NO_MODEL, "--list-bindings", Says("this list")),
    ("list-rendering-backends", NO_MODEL, "--list-rendering-backends", Says("cpu: available")),
    ("config", BOX, "--config=blue.json", Shows("--background-color=blue")),
    ("config: not there", BOX, "--config=nothing --output=o.png", Exit(2, "there is no such file")),
    ("no-config", BOX, "--no-config", Keeps),
    ("no-render", BOX, "--no-render", Says("faces     3")),
    ("load-statefile", BOX, "--load-statefile=state.json", Shows("--edges")),
    ("save-statefile", BOX, "--save-statefile=a.json", Refused("Ctrl+S")),
    ("statefile-filename", BOX, "--statefile-filename=a.json", Keeps),
    ("max-size", BOX, "--max-size=0.00001 --output=o.png", Exit(1, "--max-size")),
    ("max-size: default", BOX, "--max-size=-1", Keeps),
    ("watch", BOX, "--watch", Keeps),
    ("frame-rate", SLIDE, "--frame-rate=4 --output=f_{frame}.png", Writes("f_4.png")),
    ("load-plugins", BOX, "--load-plugins=usd", Warned),
    ("plugins-path", BOX, "--plugins-path=/opt", Warned),
    ("scan-plugins", BOX, "--scan-plugins", Warned),
    ("screenshot-filename", BOX, "--screenshot-filename={app}/{model}_{n}.png", Keeps),
    ("rendering-backend", BOX, "--rendering-backend=egl", Warned),
    ("rendering-backend=osmesa", BOX, "--rendering-backend=osmesa", Warned),
    ("rendering-backend=auto", BOX, "--rendering-backend=auto", Warned),
    ("-D", BOX, "-Drender.show_edges=true", Shows("--edges")),
    ("define", BOX, "--define=render.show_edges=true", Shows("--edges")),
    ("-R", BOX, "--config=blue.json -Rrender.background.color", Keeps),
    ("reset", BOX, "--config=blue.json --reset=render.background.color", Keeps),
    // General options.
    ("verbose", BOX, "--verbose --output=o.png", Exit(0, "drew box.obj")),
    ("verbose=debug", BOX, "--verbose=debug --output=o.png", Exit(0, "drew box.obj")),
    ("verbose=info", BOX, "--verbose=info --output=o.png", Exit(0, "wrote o.png")),
    ("verbose=quiet", BOX, "--verbose=quiet --output=o.png", Exit(0, "")),
    ("loading-progress", BOX, "--loading-progress", Keeps),
    ("animation-progress", SLIDE, "--animation-progress", Keeps),
    ("animation-progress=advanced", SLIDE, "--animation-progress=advanced", Keeps),
    ("multi-file-mode=single", NO_MODEL, "box.obj dots.ply --multi-file-mode=single --output={model}.png", Writes("dots.png")),
    ("multi-file-mode=all", NO_MODEL, "box.obj quad.gltf --multi-file-mode=all --output={model}.png", Writes("multi_file.png")),
    ("multi-file-mode=dir", NO_MODEL, "box.obj folder/inside.obj --multi-file-mode=dir --output=a{n}.png", Writes("a2.png")),
    ("multi-file-regex", NO_MODEL, r"part1.obj part2.obj --multi-file-regex=part(\d+) --output={model}.png", Writes("multi_file.png")),
    ("recursive-dir-add", NO_MODEL, "nest --recursive-dir-add --output={model}.png", Writes("inner.png")),
    ("remove-empty-file-groups", NO_MODEL, "empty.obj box.obj --remove-empty-file-groups --output={model}.png", Writes("box.png")),
    ("up=+Y", BOX, "--up=+Y", Keeps),
    ("up=+Z", BOX, "--up=+Z", Changes),
    ("-x", BOX, "-x", Shows("--axis")),
    ("axis", BOX, "--axis", Changes),
    ("x-color", BOX, "--axis --x-color=yellow", Changes),
    ("y-color", BOX, "--axis --y-color=yellow", Changes),
    ("z-color", BOX, "--axis --z-color=yellow", Changes),
    ("-g", BOX, "-g", Shows("--grid")),
    ("grid", BOX, "--grid", Changes),
    ("grid-unit", BOX, "--grid --grid-unit=2", Changes),
    ("grid-subdivisions", BOX, "--grid --grid-subdivisions=4", Changes),
    ("grid-color", BOX, "--grid --grid-color=cyan", Changes),
    ("grid-reflection", BOX, "--grid-reflection=0.5", Refused("reflect nothing")),
    ("grid-absolute", QUAD, "--grid --grid-absolute", Changes),
    ("axes-grid", BOX, "--axes-grid", Refused("--grid")),
    ("-e", BOX, "-e", Shows("--edges")),
    ("edges", BOX, "--edges", Changes),
    ("armature", "bones.gltf", "--armature", Changes),
    ("camera-index", "camera.gltf", "--camera-index=0", Changes),
    ("interaction-style=default", BOX, "--interaction-style=default", Keeps),
    ("interaction-style=trackball", BOX, "--interaction-style=trackball", Keeps),
    ("interaction-style=2d", BOX, "-k 2d", Refused("possible values: default, trackball")),
    ("invert-zoom", BOX, "--invert-zoom", Refused("wheel")),
    ("animation-autoplay", SLIDE, "--animation-autoplay", Keeps),
    ("animation-indices", SLIDE, "--animation-indices=0 --animation-time=1 --view=front", Shows("--animation-time=1 --view=front")),
    ("animation-indices: several", SLIDE, "--animation-indices=0,0 --output=o.png", Exit(0, "wrote")),
    ("animation-indices=-1", SLIDE, "--camera-position=2,1,12 --camera-focal-point=2,1,0 --animation-indices=-1 --animation-time=1", Changes),
    ("animation-indices: none such", SLIDE, "--animation-indices=7 --output=o.png", Exit(1, "0 slide")),
    ("animation-speed-factor", SLIDE, "--animation-speed-factor=50% --frame-rate=4 --output=s_{frame}.png", Writes("s_8.png")),
    ("animation-time", SLIDE, "--camera-position=2,1,12 --camera-focal-point=2,1,0 --animation-time=1", Changes),
    ("font-file", BOX, "--font-file=a.ttf", Refused("font")),
    ("font-scale", BOX, "--filename --font-scale=2", Changes),
    ("font-color", BOX, "--font-color=1,0,0", Refused("colour of text")),
    ("dpi-aware", BOX, "--dpi-aware", Keeps),
    ("command-script", BOX, "--command-script=turn.txt", Changes),
    ("backdrop-color", BOX, "--backdrop-color=navy", Refused("backdrop")),
    ("backdrop-opacity", BOX, "--backdrop-opacity=0.2", Refused("backdrop")),
    // Material options.
    ("normal-glyphs", BOX, "--normal-glyphs", Changes),
    ("normal-glyphs-scale=0.3", BOX, "--normal-glyphs --normal-glyphs-scale=0.3", Changes),
    ("normal-glyphs-scale=0.7", BOX, "--normal-glyphs --normal-glyphs-scale=0.7", Changes),
    ("-o", BOX, "-o", Shows("--point-sprites=sphere")),
    ("point-sprites", BOX, "--point-sprites=sphere", Changes),
    ("point-sprites=none", BOX, "--point-sprites=none", Keeps),
    ("point-sprites=gaussian", BOX, "--point-sprites=gaussian", Refused("possible values: none, sphere")),
    ("point-sprites-size", BOX, "-o --point-sprites-size=50", Changes),
    ("point-sprites-absolute-size", BOX, "-o --point-sprites-absolute-size --point-sprites-size=0.5", Changes),
    ("point-size", DOTS, "--point-size=10", Changes),
    ("line-width", BOX, "--edges --line-width=4", Changes),
    ("backface-type=visible", "back.gltf", "--backface-type=visible --view=back", Changes),
    ("backface-type=hidden", BOX, "--backface-type=hidden --view=back", Changes),
    ("color=red", BOX, "--color=red", Changes),
    ("color=blue", BOX, "--color=blue", Changes),
    ("opacity=1", BOX, "--opacity=1", Keeps),
    ("opacity=0.2", BOX, "--opacity=0.2", Changes),
    ("roughness=0.2", QUAD, "--roughness=0.2", Changes),
    ("roughness=0.8", QUAD, "--roughness=0.8", Changes),
    ("metallic=0", QUAD, "--metallic=0", Changes),
    ("metallic=1", QUAD, "--metallic=0.5", Changes),
    ("base-ior=2.5", QUAD, "--metallic=0 --base-ior=2.5", Changes),
    ("hdri-file", QUAD, "--hdri-file=room.hdr", Changes),
    ("hdri-ambient", QUAD, "--hdri-ambient", Changes),
    ("texture-matcap", QUAD, "--texture-matcap=paint.png", Refused("matcap")),
    ("texture-base-color", QUAD, "--texture-base-color=paint.png", Changes),
    ("texture-material", QUAD, "--texture-material=paint.png --roughness=1 --metallic=1", Changes),
    ("texture-emissive", QUAD, "--texture-emissive=paint.png", Changes),
    ("emissive-factor", QUAD, "--emissive-factor=2.0,0.1,0.1", Changes),
    ("texture-normal", QUAD, "--texture-normal=paint.png", Changes),
    ("normal-scale", QUAD, "--texture-normal=paint.png --normal-scale=2", Changes),
    ("textures-transform", QUAD, "--texture-base-color=paint.png --textures-transform=angle:10", Changes),
    ("checkerboard", QUAD, "--checkerboard", Changes),
    ("unlit", BOX, "--unlit", Changes),
    // Window options.
    ("background-color", BOX, "--background-color=orange", Changes),
    ("resolution", BOX, "--resolution=300,200", Changes),
    ("position", BOX, "--position=10,10", Refused("window manager")),
    ("-z", BOX, "-z", Keeps),
    ("fps", BOX, "--fps", Keeps),
    ("-n", BOX, "-n", Shows("--filename")),
    ("filename", BOX, "--filename", Changes),
    ("-m", BOX, "-m", Shows("--metadata")),
    ("metadata", BOX, "--metadata", Changes),
    ("scene-hierarchy", BOX, "--scene-hierarchy", Changes),
    ("notifications", BOX, "--notifications", Keeps),
    ("hdri-filename", BOX, "--hdri-file=room.hdr --hdri-filename", Changes),
    ("hdri-skybox", BOX, "--hdri-file=room.hdr --hdri-skybox", Changes),
    ("-u", BOX, "-u", Refused("blurred")),
    ("blur-coc", BOX, "--blur-coc=50", Refused("blurred")),
    ("light-intensity=1", BOX, "--light-intensity=1", Keeps),
    ("light-intensity=2", BOX, "--light-intensity=2", Changes),
    // Scientific visualization.
    ("-s", BOX, "-s", Refused("simulation")),
    ("coloring-array", BOX, "--coloring-array=Height", Refused("simulation")),
    ("-y", BOX, "-y", Refused("simulation")),
    ("-c", BOX, "-c", Refused("simulation")),
    ("coloring-range", BOX, "--coloring-range=40,200", Refused("simulation")),
    ("-b", BOX, "-b", Refused("simulation")),
    ("colormap-file", BOX, "--colormap-file=viridis", Refused("simulation")),
    ("colormap", BOX, "--colormap=0.0,black,1.0,white", Refused("simulation")),
    ("colormap-discretization", BOX, "--colormap-discretization=8", Refused("simulation")),
    ("-v", BOX, "-v", Warned),
    ("volume-opacity-file", BOX, "--volume-opacity-file=gaussian", Warned),
    ("volume-opacity-map", BOX, "--volume-opacity-map=0,0,1,1", Warned),
    ("-i", BOX, "-i", Warned),
    // The camera.
    ("camera-position", BOX, "--camera-position=3,4,5", Changes),
    ("camera-focal-point", BOX, "--camera-focal-point=1,1,1", Changes),
    ("camera-view-up", BOX, "--camera-view-up=1,1,0", Changes),
    ("camera-view-angle", BOX, "--camera-view-angle=60", Changes),
    ("camera-direction", BOX, "--camera-direction=+X", Changes),
    ("camera-zoom-factor", BOX, "--camera-zoom-factor=2", Changes),
    ("camera-azimuth-angle", BOX, "--camera-azimuth-angle=30", Changes),
    ("camera-elevation-angle", BOX, "--camera-elevation-angle=30", Changes),
    ("camera-orthographic", BOX, "--camera-orthographic", Changes),
    ("camera-orthographic true", BOX, "--camera-orthographic true", Shows("--camera-orthographic")),
    // Ray tracing and effects.
    ("-r", BOX, "-r", Warned),
    ("raytracing-samples", BOX, "--raytracing-samples=2", Warned),
    ("-d", BOX, "-d", Warned),
    ("-p", QUAD, "-p", Keeps),
    ("blending=ddp", QUAD, "--blending=ddp", Keeps),
    ("blending=stochastic", QUAD, "--blending=stochastic", Keeps),
    ("blending=sort_cpu", QUAD, "--blending=sort_cpu", Keeps),
    ("-q", BOX, "-q", Shows("--ambient-occlusion")),
    ("ambient-occlusion", BOX, "--ambient-occlusion", Changes),
    ("-a", BOX, "-a", Keeps),
    ("anti-aliasing=fxaa", BOX, "--anti-aliasing=fxaa", Keeps),
    ("anti-aliasing=ssaa", BOX, "--anti-aliasing=ssaa", Keeps),
    ("anti-aliasing=taa", BOX, "--anti-aliasing=taa", Keeps),
    ("anti-aliasing=none", BOX, "--anti-aliasing=none", Changes),
    ("-t", QUAD, "-t --light-intensity=4", Changes),
    ("final-shader", BOX, "--final-shader=x", Refused("no GPU")),
    ("display-depth", BOX, "--display-depth", Changes),
    // Testing.
    ("reference: the same", BOX, "--resolution=200,120 --reference=box_before.png", Exit(0, "within 0.04")),
    ("reference: another", BOX, "--resolution=200,120 --reference=box_before.png --view=top --output=d.png", Exit(3, "wrote d.diff.png")),
    ("reference: to be made", BOX, "--reference=missing.png --output=new.png", Exit(3, "new.png was written")),
    ("reference-threshold", BOX, "--resolution=200,120 --reference=box_before.png --view=top --reference-threshold=1", Exit(0, "within 1")),
    ("interaction-test-record", BOX, "--interaction-test-record=log", Exit(1, "no display")),
    ("interaction-test-play", BOX, "--interaction-test-play=log", Exit(1, "no display")),
    ("syntax: --option=true", BOX, "--edges=true", Shows("--edges")),
    ("syntax: --option=false", BOX, "--edges=false", Keeps),
    ("piping", NO_MODEL, "- --output=- < box.obj", Says("PNG")),
    ("piping: force-reader", NO_MODEL, "- --force-reader=obj --output=- < box.obj", Says("PNG")),
    // Names of files.
    ("{app}", BOX, "--output={app}.png", Writes("trigon-viewer.png")),
    ("{version}", BOX, "--output=v{version}.png", Writes("v0.1.0.png")),
    ("{version_full}", BOX, "--output=f{version_full}.png", Writes("f0.1.0.png")),
    ("{model}", BOX, "--output={model}_1.png", Writes("box_1.png")),
    ("{model.ext}", BOX, "--output={model.ext}.png", Writes("box.obj.png")),
    ("{model_ext}", BOX, "--output={model_ext}.png", Writes("obj.png")),
    ("{date}", BOX, "--output=day{date}.png", Exit(0, "wrote day20")),
    ("{date:format}", BOX, "--output=day{date:%Y-%m}.png", Exit(0, "wrote day20")),
    ("{n}", BOX, "--output=n{n}.png", Writes("n1.png")),
    ("{n:2}", BOX, "--output=n{n:2}.png", Writes("n01.png")),
    ("{frame}", SLIDE, "--frame-rate=2 --output=g{frame}.png", Writes("g2.png")),
    ("{frame:4}", SLIDE, "--frame-rate=2 --output=g{frame:4}.png", Writes("g0002.png")),
    ("{{model}}", BOX, "--output={{model}}.png", Writes("{model}.png")),
    // 05-ANIMATIONS.
    ("animations: frames", SLIDE, "--output=frame_{frame:04}.png", Writes("frame_0030.png")),
    ("animations: frame rate", SLIDE, "--output=frame_{frame}.png --frame-rate=30", Writes("frame_30.png")),
    ("animations: from a time", SLIDE, "--output=late_{frame}.png --frame-rate=10 --animation-time=0.5", Writes("late_5.png")),
    // 06-CONFIGURATION_FILE.
    ("configuration: a typical file", BOX, "--config=typical.json --output=o.png", Exit(0, "timer")),
    ("configuration: regex", "model.vtp.obj", "--config=regex.json", Shows("--edges")),
    ("configuration: glob", BOX, "--config=glob.json", Shows("--edges")),
    ("configuration: exact", BOX, "--config=exact.json", Keeps),
    ("configuration: imperative", BOX, "--config=imperative.json --edges=false", Shows("--edges")),
    ("configuration: the command line wins", BOX, "--config=blue.json --background-color=red", Shows("--background-color=red")),
    ("configuration: bindings", BOX, "--config=bindings.json --output=o.png", Exit(0, "bindings are ignored")),
    ("configuration: a folder", BOX, "--config=config.d", Shows("--background-color=blue")),
    // 08-PARSING.
    ("bool: yes", BOX, "--edges=Yes", Shows("--edges")),
    ("bool: on", BOX, "--edges=on", Shows("--edges")),
    ("bool: 1", BOX, "--edges=1", Shows("--edges")),
    ("bool: no", BOX, "--edges=no", Keeps),
    ("ratio: percent", BOX, "--opacity=50%", Shows("--opacity=0.5")),
    ("ratio: colon", BOX, "--opacity=1:2", Shows("--opacity=0.5")),
    ("ratio: slash", BOX, "--opacity=1/2", Shows("--opacity=0.5")),
    ("color: numbers", BOX, "--background-color=1,0,0", Shows("--background-color=red")),
    ("color: #RRGGBB", BOX, "--background-color=#ff0000", Shows("--background-color=red")),
    ("color: #RGB", BOX, "--background-color=#f00", Shows("--background-color=red")),
    ("color: rgb", BOX, "'--background-color=rgb(84, 84, 84)'", Shows("--background-color=#545454")),
    ("color: hsl", BOX, "'--background-color=hsl(0, 100%, 50%)'", Shows("--background-color=red")),
    ("color: hsv", BOX, "'--background-color=hsv(0, 100%, 100%)'", Shows("--background-color=red")),
    ("color: hwb", BOX, "'--background-color=hwb(0, 0%, 0%)'", Shows("--background-color=red")),
    ("color: cmyk", BOX, "'--background-color=cmyk(0%, 100%, 100%, 0%)'", Shows("--background-color=red")),
    ("color: a name", BOX, "--background-color=Red", Shows("--background-color=#f00")),
    ("color: F3D's", BOX, "--background-color=f3d_red", Changes),
    ("direction: X", BOX, "--camera-direction=X", Shows("--camera-direction=1,0,0")),
    ("direction: -y+z", BOX, "--camera-direction=-y+z", Shows("--camera-direction=0,-1,1")),
    ("direction: numbers", BOX, "--camera-direction=1,2,3.4", Changes),
    ("transform2d: parts", QUAD, "--texture-base-color=paint.png '--textures-transform=scale: 2; angle: 10'", Changes),
    ("transform2d: a matrix", QUAD, "--texture-base-color=paint.png --textures-transform=2,0,0,0,2,0,0,0,1", Changes),
    // 11-FINAL_SHADER, 12-DESKTOP_INTEGRATION, 14-LIMITATIONS_AND_TROUBLESHOOTING.
    ("final shader: from a file", BOX, "--final-shader 'vec4 pixel(vec2 uv){}'", Refused("no GPU")),
    ("desktop: thumbnails", BOX, "--config=thumbnail.json --max-size=100 --output=thumb.png", Writes("thumb.png")),
    ("limits: splats", BOX, "--point-sprites-size=1 --point-sprites=gaussian -syk", Refused("possible values: none, sphere")),
    ("limits: colours of STEP files", BOX, "--color=Blue --scalar-coloring=no", Refused("simulation")),
];

/// Lines of a script, tried with a picture at the end: what it shows is what the flags show.
#[rustfmt::skip]
const COMMANDS: &[Row] = &[
    ("set", BOX, "set scene.up.direction +Z", Shows("--up=+Z")),
    ("set: quotes", BOX, "set render.hdri.file \"room with spaces.hdr\"", Shows("'--hdri-file=room with spaces.hdr'")),
    ("set: escapes", BOX, r"set scene.up.direction +\Z", Shows("--up=+Z")),
    ("set: an escaped space", BOX, r"set render.hdri.file room\ with\ spaces.hdr", Shows("'--hdri-file=room with spaces.hdr'")),
    ("set: a quote that is not closed", BOX, "set scene.up.direction \"+Z", Exit(2, "not closed")),
    ("set: an escape at the end", BOX, r"set scene.up.direction +Z\", Exit(2, "backslash")),
    ("a comment", BOX, "# A comment", Keeps),
    ("toggle", BOX, "toggle render.show_edges", Shows("--edges")),
    ("toggle ui.scalar_bar", BOX, "toggle ui.scalar_bar", Exit(2, "not an option")),
    ("toggle ui.filename", BOX, "toggle ui.filename", Shows("--filename")),
    ("toggle render.grid.enable", BOX, "toggle render.grid.enable", Shows("--grid")),
    ("toggle scene.camera.orthographic", BOX, "toggle scene.camera.orthographic", Shows("--camera-orthographic")),
    ("toggle ui.axis", BOX, "toggle ui.axis", Shows("--axis")),
    ("reset", BOX, "set color red\nreset model.color.rgb", Keeps),
    ("reset blur", BOX, "reset render.background.blur.coc", Exit(2, "blurred")),
    ("clear", BOX, "clear", Keeps),
    ("print", BOX, "print scene.up.direction", Exit(0, "+Y")),
    ("set_reader_option", BOX, "set_reader_option QuakeMDL.skin_index 1", Exit(0, "no options")),
    ("increase", BOX, "increase render.light.intensity", Shows("--light-intensity=1.1")),
    ("decrease", BOX, "decrease render.light.intensity", Shows("--light-intensity=0.9")),
    ("cycle", BOX, "cycle render.effect.blending.mode", Keeps),
    ("cycle_animation", SLIDE, "cycle_animation", Exit(2, "set animation-indices")),
    ("cycle_coloring", BOX, "cycle_coloring array", Exit(2, "simulation")),
    ("roll_camera", BOX, "roll_camera 120", Changes),
    ("elevation_camera", BOX, "elevation_camera 30", Changes),
    ("azimuth_camera", BOX, "azimuth_camera 120", Changes),
    ("print_scene_info", BOX, "print_scene_info", Says("faces     3")),
    ("print_coloring_info", BOX, "print_coloring_info", Says("faces     3")),
    ("print_mesh_info", BOX, "print_mesh_info", Says("faces     3")),
    ("print_options_info", BOX, "print_options_info", Exit(0, "resolution")),
    ("print_config_info", BOX, "print_config_info", Exit(0, "resolution")),
    ("set_camera top", BOX, "set_camera top", Shows("--view=top")),
    ("set_camera isometric", BOX, "set_camera isometric", Shows("--view=iso")),
    ("toggle_volume_rendering", BOX, "toggle_volume_rendering", Exit(0, "no volumes")),
    ("stop_interactor", BOX, "stop_interactor\nset up +Z", Keeps),
    ("reset_camera", BOX, "roll_camera 20\nreset_camera", Keeps),
    ("toggle_animation", SLIDE, "toggle_animation", Keeps),
    ("toggle_animation_backward", SLIDE, "toggle_animation_backward", Keeps),
    ("jump_to_frame 0", SLIDE, "set camera-position 2,1,12\nset camera-focal-point 2,1,0\njump_to_frame 0", Shows("--camera-position=2,1,12 --camera-focal-point=2,1,0 --animation-time=0")),
    ("jump_to_frame 10", SLIDE, "set camera-position 2,1,12\nset camera-focal-point 2,1,0\nset frame-rate 20\njump_to_frame 10", Shows("--camera-position=2,1,12 --camera-focal-point=2,1,0 --animation-time=0.5")),
    ("jump_to_frame -1", SLIDE, "set camera-position 2,1,12\nset camera-focal-point 2,1,0\njump_to_frame -1", Shows("--camera-position=2,1,12 --camera-focal-point=2,1,0 --animation-time=1")),
    ("jump_to_frame -2", SLIDE, "set camera-position 2,1,12\nset camera-focal-point 2,1,0\nset frame-rate 2\njump_to_frame -2", Shows("--camera-position=2,1,12 --camera-focal-point=2,1,0 --animation-time=0.5")),
    ("jump_to_frame_relative", SLIDE, "set camera-position 2,1,12\nset camera-focal-point 2,1,0\nset frame-rate 2\njump_to_frame_relative 1", Shows("--camera-position=2,1,12 --camera-focal-point=2,1,0 --animation-time=0.5")),
    ("jump_to_keyframe", SLIDE, "set camera-position 2,1,12\nset camera-focal-point 2,1,0\njump_to_keyframe 1", Shows("--camera-position=2,1,12 --camera-focal-point=2,1,0 --animation-time=1")),
    ("jump_to_keyframe 10", SLIDE, "set camera-position 2,1,12\nset camera-focal-point 2,1,0\njump_to_keyframe 10", Shows("--camera-position=2,1,12 --camera-focal-point=2,1,0 --animation-time=1")),
    ("jump_to_keyframe_relative", SLIDE, "set camera-position 2,1,12\nset camera-focal-point 2,1,0\njump_to_keyframe_relative 1", Shows("--camera-position=2,1,12 --camera-focal-point=2,1,0 --animation-time=1")),
    ("jump_to_time", SLIDE, "set camera-position 2,1,12\nset camera-focal-point 2,1,0\njump_to_time 0.5", Shows("--camera-position=2,1,12 --camera-focal-point=2,1,0 --animation-time=0.5")),
    ("jump_to_time_relative", SLIDE, "set camera-position 2,1,12\nset camera-focal-point 2,1,0\njump_to_time 1\njump_to_time_relative -0.5", Shows("--camera-position=2,1,12 --camera-focal-point=2,1,0 --animation-time=0.5")),
    ("cycle_verbose_level", BOX, "cycle_verbose_level", Keeps),
    ("add_files", BOX, "add_files dots.ply\nload_next_file_group\nprint_scene_info", Says("dots.ply")),
    ("save_statefile", BOX, "save_statefile state.json", Exit(2, "--statefile")),
    ("load_statefile", BOX, "load_statefile state.json", Exit(2, "--statefile")),
    ("save_statefile_to_clipboard", BOX, "save_statefile_to_clipboard", Exit(2, "--statefile")),
    ("load_statefile_from_clipboard", BOX, "load_statefile_from_clipboard", Exit(2, "--statefile")),
    ("alias", BOX, "alias myrotate roll_camera 90\nmyrotate", Changes),
    ("help", BOX, "help set_camera", Exit(0, "set_camera")),
    ("exit", BOX, "exit", Keeps),
    ("load_previous_file_group", BOX, "add_files dots.ply\nload_previous_file_group\nprint_scene_info", Says("dots.ply")),
    ("load_next_file_group", BOX, "load_next_file_group", Keeps),
    ("reload_current_file_group", BOX, "reload_current_file_group", Keeps),
    ("add_current_directories", BOX, "add_current_directories", Exit(2, "command line")),
    ("take_screenshot", BOX, "take_screenshot shot.png", Writes("shot.png")),
    ("take_minimal_screenshot", BOX, "take_minimal_screenshot minimal.png", Writes("minimal.png")),
    ("set_hdri", BOX, "set_hdri room.hdr", Shows("--hdri-file=room.hdr --hdri-skybox")),
    ("add_files_or_set_hdri", BOX, "add_files_or_set_hdri room.hdr", Shows("--hdri-file=room.hdr --hdri-skybox")),
    ("remove_current_file_group", BOX, "remove_current_file_group", Exit(2, "command line")),
    ("remove_file_groups", BOX, "remove_file_groups", Exit(2, "command line")),
    ("open_file_dialog", BOX, "open_file_dialog", Exit(2, "add_files")),
    ("save_statefile_dialog", BOX, "save_statefile_dialog", Exit(2, "--statefile")),
    ("load_statefile_dialog", BOX, "load_statefile_dialog", Exit(2, "--statefile")),
    ("the example of a script", BOX, "# A comment\nroll_camera 90\nprint_scene_info # Another comment\nincrease_light_intensity", Changes),
];

/// A folder with all that the examples name, removed at the end.
struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        let folder = Self(tempfile::tempdir().expect("a temporary folder"));
        for name in ["folder", "nest", "nest/deep", "config.d"] {
            fs::create_dir(folder.path(name)).expect("a folder");
        }
        for (name, contents) in [
            ("box.obj", CORNER),
            ("model.vtp.obj", CORNER),
            ("folder/inside.obj", CORNER),
            ("nest/deep/inner.obj", CORNER),
            ("part1.obj", CORNER),
            ("part2.obj", "v 2 0 0\nv 3 0 0\nv 2 1 0\nf 1 2 3\n"),
            ("empty.obj", ""),
            ("dots.ply", DOTS_PLY),
            ("turn.txt", "# A comment\nroll_camera 90\nprint_scene_info # Another comment\n"),
            ("blue.json", r#"[{"options": {"background-color": "blue"}}]"#),
            ("config.d/1.json", r#"[{"options": {"background-color": "red"}}]"#),
            ("config.d/2.json", r#"[{"options": {"render.background.color": "blue"}}]"#),
            ("regex.json", r#"[{"match": ".*vt.\\.obj", "options": {"edges": true}}]"#),
            ("glob.json", r#"[{"match-type": "glob", "match": "**/*.{o,g}bj", "options": {"edges": true}}]"#),
            (
                "exact.json",
                r#"[{"match-type": "exact", "match": "/path/to/file.mhd", "options": {"edges": true}}]"#,
            ),
            ("imperative.json", r#"[{"options": {"!edges": true}}]"#),
            ("bindings.json", r#"[{"bindings": {"Ctrl+Shift+O": "toggle ui.filename"}}]"#),
            (
                "thumbnail.json",
                r#"[{"options": {"no-background": true, "anti-aliasing": "ssaa", "verbose": "quiet"}}]"#,
            ),
            ("typical.json", TYPICAL),
            (
                "state.json",
                r#"{"format": "trigon state 1", "files": ["box.obj"], "options": {"style": "edges"}}"#,
            ),
            ("slide.gltf", &slide()),
            ("quad.gltf", &quad("")),
            ("camera.gltf", &quad(r#", {"camera": 0, "translation": [0, 0, 9]}"#)),
            ("back.gltf", &quad("").replace("\"doubleSided\": true", "\"doubleSided\": false")),
            ("bones.gltf", &bones()),
        ] {
            fs::write(folder.path(name), contents).expect("written");
        }
        for name in ["room.hdr", "room with spaces.hdr"] {
            fs::write(folder.path(name), room()).expect("written");
        }
        let paint: Vec<u8> = (0..64).flat_map(|i: u8| [i * 4, 255 - i * 4, 200, 255]).collect();
        let pixels = trigon_io::Pixels::Rgba8(&paint);
        trigon_io::write_png(folder.path("paint.png"), 8, 8, pixels).expect("written");
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn run(&self, words: &str) -> Output {
        let mut words = split(words);
        let input = words.iter().position(|word| word == "<").map(|at| words.split_off(at).remove(1));
        let mut command = Command::new(env!("CARGO_BIN_EXE_trigon-viewer"));
        command.args(&words).current_dir(self.0.path());
        for variable in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
            command.env_remove(variable);
        }
        command.env("XDG_CONFIG_HOME", self.path("no-config"));
        if let Some(name) = input {
            command.stdin(fs::File::open(self.path(&name)).expect("it is there"));
        }
        command.output().expect("the viewer starts")
    }

    /// The pixels of a picture.
    fn picture(&self, words: &str) -> Result<(trigon_io::Picture, String), String> {
        let size = if words.contains("--resolution") { "" } else { "--resolution=60,40" };
        let output = self.run(&format!("{size} {words} --output=picture.png"));
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        if output.status.code() != Some(0) {
            return Err(format!("`{words}` said: {said}"));
        }
        let picture = trigon_io::load_image(self.path("picture.png"), &trigon_io::Limits::default());
        Ok((picture.expect("a picture"), said))
    }

    /// Whether two command lines show the same.
    fn same(&self, one: &str, other: &str) -> Result<bool, String> {
        Ok(self.picture(one)?.0 == self.picture(other)?.0)
    }

    /// Whether a run ends with a code and says something.
    fn ends(&self, words: &str, code: i32, part: &str) -> Result<(), String> {
        let small = if words.contains("--output") && !words.contains("--resolution") {
            "--resolution=60,40"
        } else {
            ""
        };
        let output = self.run(&format!("{small} {words}"));
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        let (said, out) = (text(&output.stderr), text(&output.stdout));
        let is_said = said.contains(part) || (code == 0 && out.contains(part));
        let is_fine = output.status.code() == Some(code) && is_said && !said.contains("panicked");
        holds(is_fine, || {
            format!("`{words}` ended with {:?}, not with {part:?}: {said}", output.status.code())
        })
    }

    /// What a row says, or why that is not so.
    fn check(&self, file: &str, words: &str, plain: &str, expected: Expected) -> Result<(), String> {
        let whole = format!("{file} {words}");
        match expected {
            Changes => holds(!self.same(&whole, plain)?, || "it changes nothing".to_owned()),
            Keeps => holds(self.same(&whole, plain)?, || "it changes something".to_owned()),
            Shows(flags) => {
                let shown = format!("{file} {flags}");
                let is_plain = self.same(&shown, plain)? && !plain.contains("-time");
                holds(!is_plain, || format!("{flags} shows nothing"))?;
                holds(self.same(&whole, &shown)?, || format!("it is not what {flags} shows"))
            }
            Says(part) => self.ends(&whole, 0, part),
            Writes(path) => {
                // Old ones would hide that nothing is written.
                let _ = fs::remove_file(self.path(path));
                self.ends(&whole, 0, "")?;
                holds(self.path(path).is_file(), || format!("{path} is not written"))
            }
            Exit(code, part) => self.ends(&whole, code, part),
            Warned => {
                let said = self.picture(&whole)?.1;
                holds(said.contains(" is ignored: "), || format!("no warning: {said}"))?;
                holds(self.same(&whole, plain)?, || "it changes something".to_owned())
            }
            Refused(reason) => self.ends(&whole, 2, reason),
        }
    }
}

fn holds(condition: bool, otherwise: impl FnOnce() -> String) -> Result<(), String> {
    if condition { Ok(()) } else { Err(otherwise()) }
}

/// Words, with what stands in single quotes as one.
fn split(text: &str) -> Vec<String> {
    let parts = text.split('\'').enumerate();
    let words = parts.flat_map(|(index, part)| match index % 2 {
        0 => part.split_whitespace().map(str::to_owned).collect(),
        _ => vec![part.to_owned()],
    });
    words.collect()
}

/// Without the flag, but with what it needs to show anything, and as large.
fn plain(file: &str, words: &str) -> String {
    let needed = |word: &&str| {
        let last = words.split_whitespace().last();
        let is_base =
            ["--axis", "--grid", "--edges", "--filename", "--normal-glyphs", "-o", "--hdri-file=room.hdr"];
        let tuned = [
            "--camera-position=2,",
            "--camera-focal-point=2,",
            "--texture-",
            "--metallic=0",
            "--view",
            "--light-intensity=4",
            "--config",
        ];
        Some(*word) != last && (is_base.contains(word) || tuned.iter().any(|part| word.starts_with(part)))
    };
    let needed: Vec<&str> = words.split_whitespace().filter(needed).collect();
    let size = if words.contains("--resolution=300") { " --resolution=60,40" } else { "" };
    let needed = needed.join(" ");
    let needed =
        if needed.contains("--config") || needed.contains("--texture-material") { "" } else { &needed };
    format!("{file} {needed}{size}")
}

#[test]
fn every_documented_option_does_what_it_does_in_f3d_or_says_why_not() {
    let folder = Folder::new();
    folder.run("box.obj --resolution=200,120 --output=box_before.png");
    let failed = OPTIONS.iter().filter_map(|&(name, file, words, expected)| {
        let checked = folder.check(file, words, &plain(file, words), expected);
        checked.err().map(|why| format!("{name}: {why}"))
    });
    let failed: Vec<String> = failed.collect();
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

#[test]
fn every_documented_command_does_what_it_does_in_f3d_or_says_why_not() {
    let folder = Folder::new();
    let failed = COMMANDS.iter().filter_map(|&(name, file, script, expected)| {
        fs::write(folder.path("script.txt"), script).expect("written");
        let mut words = "--command-script=script.txt".to_owned();
        if !matches!(expected, Changes | Keeps | Shows(_)) {
            words += " --resolution=60,40 --output=o.png";
        }
        // The first of those jumps is at the start.
        let time = if script.contains("jump_to") { " --animation-time=0" } else { "" };
        let checked = folder.check(file, &words, &format!("{file}{time}"), expected);
        checked.err().map(|why| format!("{name}: {why}"))
    });
    let failed: Vec<String> = failed.collect();
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

/// At least seven of ten do the same; warned are flags of graphics cards and plugins alone.
#[test]
fn most_examples_work_and_only_those_of_cards_and_plugins_are_warned_of() {
    let rows = || OPTIONS.iter().chain(COMMANDS);
    let refused = rows().filter(|row| matches!(row.3, Refused(_) | Exit(2, _))).count();
    let warned: Vec<&Row> = rows().filter(|row| matches!(row.3, Warned)).collect();
    let (all, warned_count) = (rows().count(), warned.len());
    let same = all - refused - warned_count;
    assert!(same * 10 >= all * 7, "{same} of {all} are the same");
    for (_, _, words, _) in warned {
        let cards = ["plugins", "rendering-backend", "raytracing", "volume", "-r", "-d", "-v", "-i"];
        assert!(cards.iter().any(|part| words.contains(part)), "{words}");
    }
}

const CORNER: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\n\
    f 1 4 3 2\nf 1 2 6 5\nf 1 5 7 4\n";

const DOTS_PLY: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
    property float z\nend_header\n0 0 0\n1 0 0\n0 1 0\n";

/// The first example of 06-CONFIGURATION_FILE: some of its names have gone from F3D, too.
const TYPICAL: &str = r#"[
  {"options": {"background-color": "0.7,0.7,0.7", "color": "0.5,0.1,0.1", "anti-aliasing": true,
    "timer": true, "progress": true, "axis": true, "bar": true, "roughness": 0.2, "grid": true,
    "scalar-coloring": true}},
  {"match": ".*vt.", "options": {"edges": true}},
  {"match": ".*gl(tf|b)", "options": {"raytracing": true, "denoise": true, "samples": 3}},
  {"match": ".*mhd", "options": {"volume": true}}
]"#;

/// Light from above and darkness below, as a Radiance picture.
fn room() -> Vec<u8> {
    let mut bytes = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 16\n".to_vec();
    bytes.extend((0..128).flat_map(|index| if index < 64 { [0, 0, 128, 129] } else { [128, 0, 0, 129] }));
    bytes
}

/// The bytes of numbers as a URI.
fn uri(numbers: &[f32]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
    let length = bytes.len();
    bytes.resize(length.next_multiple_of(3), 0);
    let text = bytes.chunks(3).flat_map(|three| {
        let bits = u32::from_be_bytes([0, three[0], three[1], three[2]]);
        [18, 12, 6, 0].map(|shift| char::from(LETTERS[(bits >> shift) as usize & 63]))
    });
    let mut text: String = text.collect();
    let extra = bytes.len() - length;
    text.replace_range(text.len() - extra.., &"=".repeat(extra));
    format!("data:application/octet-stream;base64,{text}")
}

/// A metallic quad with texture coordinates, a translucent one before it, and more nodes.
fn quad(nodes: &str) -> String {
    let positions =
        [-1.0, -1.0, 0.0, 1.0, -1.0, 0.0, 1.0, 1.0, 0.0, -1.0, -1.0, 0.0, 1.0, 1.0, 0.0, -1.0, 1.0, 0.0];
    let uvs = [0.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0];
    let numbers: Vec<f32> = positions.into_iter().chain(uvs).collect();
    format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0, 1{more}]}}],
        "nodes": [{{"mesh": 0}}, {{"mesh": 1, "translation": [0.3, 0.3, 0.5], "scale": [0.5, 0.5, 0.5]}}{nodes}],
        "cameras": [{{"type": "perspective", "perspective": {{"yfov": 0.5, "znear": 0.1}}}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0, "TEXCOORD_0": 1}}, "material": 0}}]}},
            {{"primitives": [{{"attributes": {{"POSITION": 0, "TEXCOORD_0": 1}}, "material": 1}}]}}],
        "materials": [{{"pbrMetallicRoughness": {{"metallicFactor": 1.0, "roughnessFactor": 0.5}}, "doubleSided": true}},
            {{"pbrMetallicRoughness": {{"baseColorFactor": [1, 0, 0, 0.5], "metallicFactor": 1.0}}, "alphaMode": "BLEND", "doubleSided": true}}],
        "buffers": [{{"byteLength": 120, "uri": "{uri}"}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 72}}, {{"buffer": 0, "byteOffset": 72, "byteLength": 48}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]}},
            {{"bufferView": 1, "componentType": 5126, "count": 6, "type": "VEC2"}}]}}"#,
        more = if nodes.is_empty() { "" } else { ", 2" },
        uri = uri(&numbers)
    )
}

/// A triangle that goes 3 m to the right within a second.
fn slide() -> String {
    let numbers = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 3.0, 0.0, 0.0];
    format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}}],
        "buffers": [{{"byteLength": 68, "uri": "{}"}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 36}}, {{"buffer": 0, "byteOffset": 36, "byteLength": 8}},
            {{"buffer": 0, "byteOffset": 44, "byteLength": 24}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}},
            {{"bufferView": 1, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]}},
            {{"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"}}],
        "animations": [{{"name": "slide", "samplers": [{{"input": 1, "output": 2}}],
            "channels": [{{"sampler": 0, "target": {{"node": 0, "path": "translation"}}}}]}}]}}"#,
        uri(&numbers)
    )
}

/// A quad beside two joints, one above the other.
fn bones() -> String {
    let quad = quad(r#", {"children": [3]}, {"translation": [0.5, 1.5, 0.2]}"#);
    let quad = quad.replacen(r#"{"mesh": 0}"#, r#"{"mesh": 0, "skin": 0}"#, 1);
    quad.replacen(r#""materials""#, r#""skins": [{"joints": [2, 3]}], "materials""#, 1)
}
