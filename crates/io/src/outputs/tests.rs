//! Frames are written, read back by other means, and compared bit for bit.

use exr::prelude::{FlatSamples, ReadChannels, ReadLayers, read};
use trigon_math::{Vec2, Vec3, Vec4};
use trigon_scene::{Frame, Outputs, RenderSettings, render, showcase};

use super::*;
use crate::write::WriteError;

/// A small image of everything.
fn frame() -> Frame {
    let mut outputs = Outputs::default();
    Output::ALL.into_iter().for_each(|output| output.ask_for(&mut outputs));
    let settings = RenderSettings { outputs, samples_per_axis: 1, ..RenderSettings::new(37, 23) };
    let scene = showcase();
    render(&scene, &scene.overview(settings.aspect()), &settings).expect("drawn")
}

/// Type, shape and numbers of an array, as NumPy's documentation tells to read it.
fn parse_npy(bytes: &[u8]) -> (String, Vec<usize>, &[u8]) {
    assert!(bytes.starts_with(b"\x93NUMPY\x01\x00"), "magic and version");
    let length = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    let (header, numbers) = bytes[10..].split_at(length);
    assert_eq!((10 + length) % 64, 0, "aligned");
    let header = std::str::from_utf8(header).expect("ASCII");
    assert!(header.ends_with('\n'), "one line: {header:?}");
    let after = |key: &str| &header[header.find(key).expect("there is the key") + key.len()..];
    assert!(after("'fortran_order': ").starts_with("False"), "C order: {header}");
    let kind = after("'descr': '").split('\'').next().expect("a type").to_owned();
    let shape = after("'shape': (").split(')').next().expect("a shape");
    let shape = shape.split(", ").map(|size| size.parse().expect("a number")).collect();
    (kind, shape, numbers)
}

/// The bytes of numbers in the order of memory.
fn bytes_of(floats: impl IntoIterator<Item = f32>) -> Vec<u8> {
    floats.into_iter().flat_map(f32::to_le_bytes).collect()
}

fn bytes_of_ids(ids: &Option<Vec<u32>>) -> Vec<u8> {
    ids.as_ref().expect("asked for").iter().flat_map(|id| id.to_le_bytes()).collect()
}

fn bytes_of_vectors(vectors: &Option<Vec<Vec3>>) -> Vec<u8> {
    bytes_of(vectors.as_ref().expect("asked for").iter().flat_map(|vector| vector.to_array()))
}

#[test]
fn arrays_hold_the_frame_bit_for_bit() {
    let frame = frame();
    for output in Output::ALL {
        let mut bytes = Vec::new();
        encode_npy(&mut bytes, &frame, output).expect("memory takes it");
        let uvs = || bytes_of(frame.uvs.iter().flatten().flat_map(Vec2::to_array));
        let (kind, last, numbers) = match output {
            Output::Color => ("|u1", Some(4), frame.color.clone()),
            Output::Radiance => {
                ("<f4", Some(4), bytes_of(frame.radiance.iter().flatten().flat_map(Vec4::to_array)))
            }
            Output::Depth => ("<f4", None, bytes_of(frame.depth.iter().flatten().copied())),
            Output::ObjectIds => ("<u4", None, bytes_of_ids(&frame.object_ids)),
            Output::FaceIds => ("<u4", None, bytes_of_ids(&frame.face_ids)),
            Output::MaterialIds => ("<u4", None, bytes_of_ids(&frame.material_ids)),
            Output::TriangleIds => ("<u4", None, bytes_of_ids(&frame.triangle_ids)),
            Output::Barycentrics => ("<f4", Some(3), bytes_of_vectors(&frame.barycentrics)),
            Output::Positions => ("<f4", Some(3), bytes_of_vectors(&frame.positions)),
            Output::Normals => ("<f4", Some(3), bytes_of_vectors(&frame.normals)),
            Output::GeometricNormals => ("<f4", Some(3), bytes_of_vectors(&frame.geometric_normals)),
            Output::Uvs => ("<f4", Some(2), uvs()),
            Output::Albedo => ("<f4", Some(3), bytes_of_vectors(&frame.albedo)),
        };
        let shape: Vec<usize> = [23, 37].into_iter().chain(last).collect();
        assert_eq!(parse_npy(&bytes), (kind.to_owned(), shape, numbers.as_slice()), "{output}");
    }
}

/// The channels of an OpenEXR file, read by the crate's own reader.
fn exr_channels(bytes: &[u8]) -> Vec<(String, FlatSamples)> {
    let reader = read().no_deep_data().largest_resolution_level().all_channels().first_valid_layer();
    let image = reader.all_attributes().from_buffered(std::io::Cursor::new(bytes)).expect("an image");
    let layer = image.layer_data;
    assert_eq!((layer.size.x(), layer.size.y()), (37, 23), "the size");
    let channels = layer.channel_data.list.into_iter();
    channels.map(|channel| (channel.name.to_string(), channel.sample_data)).collect()
}

#[test]
fn open_exr_holds_the_frame_bit_for_bit() {
    let frame = frame();
    let mut bytes = Vec::new();
    encode_exr(&mut bytes, &frame).expect("memory takes it");
    let channels = exr_channels(&bytes);
    let names: Vec<&str> = channels.iter().map(|(name, _)| name.as_str()).collect();
    let expected = "A B G N.X N.Y N.Z Ng.X Ng.Y Ng.Z P.X P.Y P.Z R U V Z albedo.B albedo.G albedo.R \
        barycentric.X barycentric.Y barycentric.Z id.face id.material id.object id.triangle";
    assert_eq!(names.join(" "), expected, "all channels");
    let channel = |name: &str| &channels[names.iter().position(|it| *it == name).expect("it is there")].1;
    let ids = |name: &str, ids: &Option<Vec<u32>>| {
        let FlatSamples::U32(read) = channel(name) else { panic!("{name} is not u32") };
        assert_eq!(Some(read), ids.as_ref(), "{name}");
    };
    ids("id.object", &frame.object_ids);
    ids("id.face", &frame.face_ids);
    ids("id.material", &frame.material_ids);
    ids("id.triangle", &frame.triangle_ids);
    let floats = |name: &str, expected: Vec<f32>| {
        let FlatSamples::F32(read) = channel(name) else { panic!("{name} is not f32") };
        assert_eq!(bytes_of(read.iter().copied()), bytes_of(expected), "{name}");
    };
    floats("Z", frame.depth.clone().expect("asked for"));
    let lights = frame.radiance.as_ref().expect("asked for");
    for (name, at) in [("R", 0), ("G", 1), ("B", 2), ("A", 3)] {
        floats(name, lights.iter().map(|light| light[at]).collect());
    }
    let uvs = frame.uvs.as_ref().expect("asked for");
    floats("U", uvs.iter().map(|uv| uv.x).collect());
    floats("V", uvs.iter().map(|uv| uv.y).collect());
    for (name, letters, vectors) in [
        ("barycentric", "XYZ", &frame.barycentrics),
        ("P", "XYZ", &frame.positions),
        ("N", "XYZ", &frame.normals),
        ("Ng", "XYZ", &frame.geometric_normals),
        ("albedo", "RGB", &frame.albedo),
    ] {
        for (axis, letter) in letters.chars().enumerate() {
            let column = vectors.iter().flatten().map(|vector| vector[axis]);
            floats(&format!("{name}.{letter}"), column.collect());
        }
    }
}

#[test]
fn open_exr_colours_are_linear_and_premultiplied() {
    let mut color = [255, 255, 0, 51, 255, 0, 188, 255].repeat(426);
    color.truncate(4 * 37 * 23);
    let frame = Frame { width: 37, height: 23, color, ..Frame::default() };
    let mut bytes = Vec::new();
    encode_exr(&mut bytes, &frame).expect("memory takes it");
    let first: Vec<f32> = exr_channels(&bytes)
        .into_iter()
        .flat_map(|(_, samples)| samples.values_as_f32().take(2).collect::<Vec<_>>())
        .collect();
    let half = trigon_math::color::srgb8_to_linear(188);
    assert_eq!(first, [0.2, 1.0, 0.0, half, 0.2, 0.0, 0.2, 1.0], "A, B, G, R of two pixels");
}

/// A row of pixels with a depth or an id each.
fn row(depth: Option<Vec<f32>>, ids: Option<Vec<u32>>, normals: Option<Vec<Vec3>>) -> Frame {
    let length =
        depth.as_ref().map(Vec::len).or(ids.as_ref().map(Vec::len)).or(normals.as_ref().map(Vec::len));
    let width = length.expect("one of them") as u32;
    Frame { width, height: 1, depth, object_ids: ids, normals, ..Frame::default() }
}

fn png16(frame: &Frame, output: Output) -> Result<image::DynamicImage, WriteError> {
    let mut bytes = Vec::new();
    encode_png16(&mut bytes, frame, output)?;
    Ok(image::load_from_memory(&bytes).expect("a PNG"))
}

#[test]
fn sixteen_bits_hold_what_fits() {
    let depth = row(Some(vec![f32::INFINITY, 1e-6, 1.0, 2.0004, 65.535]), None, None);
    let depth = png16(&depth, Output::Depth).expect("it fits").into_luma16().into_raw();
    assert_eq!(depth, [0, 1, 1000, 2000, 65535], "millimetres; 0 is background");
    let ids = row(None, Some(vec![u32::MAX, 0, 65534]), None);
    let ids = png16(&ids, Output::ObjectIds).expect("it fits").into_luma16().into_raw();
    assert_eq!(ids, [65535, 0, 65534], "65535 is background");
    let normals = row(None, None, Some(vec![Vec3::new(-1.0, 1.0, 0.0), Vec3::ZERO]));
    let normals = png16(&normals, Output::Normals).expect("it fits").into_rgb16().into_raw();
    assert_eq!(normals, [0, 65535, 32768, 32768, 32768, 32768], "from -1 to 1");
}

#[test]
fn what_does_not_fit_sixteen_bits_is_refused() {
    let message = |frame: &Frame, output| png16(frame, output).expect_err("refused").to_string();
    let far = message(&row(Some(vec![70.0]), None, None), Output::Depth);
    assert!(far.contains("70 m") && far.contains(".npy"), "{far}");
    let behind = message(&row(Some(vec![-2.0]), None, None), Output::Depth);
    assert!(behind.contains("-2 m"), "{behind}");
    let many = message(&row(None, Some(vec![65535]), None), Output::ObjectIds);
    assert!(many.contains("65535") && many.contains(".exr"), "{many}");
    let frame = frame();
    for output in [
        Output::Color,
        Output::Radiance,
        Output::Positions,
        Output::Uvs,
        Output::Albedo,
        Output::Barycentrics,
    ] {
        let refusal = message(&frame, output);
        assert!(refusal.starts_with(output.name()), "{refusal}");
    }
}

#[test]
fn what_the_frame_does_not_hold_is_named() {
    let bare = Frame { width: 1, height: 1, color: vec![0; 4], ..Frame::default() };
    let error = encode_npy(Vec::new(), &bare, Output::Depth).expect_err("not asked for");
    assert_eq!(error.to_string(), "the frame has no depth; request it in RenderSettings::outputs", "named");
    let empty = Frame { width: 1, height: 1, ..Frame::default() };
    assert!(matches!(encode_exr(Vec::new(), &empty), Err(WriteError::Absent { .. })), "nothing at all");
    let torn = Frame { depth: Some(vec![1.0; 3]), ..bare };
    for result in [encode_npy(Vec::new(), &torn, Output::Depth), encode_exr(Vec::new(), &torn)] {
        assert!(matches!(result, Err(WriteError::Size { length: 3, .. })), "sizes must fit");
    }
}

#[test]
fn files_are_written_whole_and_errors_name_them() {
    let (frame, folder) = (frame(), tempfile::tempdir().expect("a temporary folder"));
    let path = |name: &str| folder.path().join(name);
    write_npy(path("a.npy"), &frame, Output::Depth).expect("written");
    write_exr(path("a.exr"), &frame).expect("written");
    write_png16(path("a.png"), &frame, Output::Normals).expect("written");
    assert_eq!(std::fs::read_dir(folder.path()).expect("a folder").count(), 3, "no temporary file");
    let mut whole: [Vec<u8>; 3] = Default::default();
    encode_npy(&mut whole[0], &frame, Output::Depth).expect("memory takes it");
    encode_exr(&mut whole[1], &frame).expect("memory takes it");
    encode_png16(&mut whole[2], &frame, Output::Normals).expect("memory takes it");
    for (name, expected) in ["a.npy", "a.exr", "a.png"].into_iter().zip(whole) {
        assert!(std::fs::read(path(name)).expect("a file") == expected, "{name} has other bytes");
    }
    let error = write_npy(path("no/a.npy"), &frame, Output::Depth).expect_err("no such folder");
    assert!(error.to_string().contains("a.npy"), "{error}");
}

#[test]
fn names_are_unique_and_lead_back() {
    for output in Output::ALL {
        assert_eq!(output.name().parse(), Ok(output), "{output}");
    }
    let error = "dept".parse::<Output>().expect_err("a typing error");
    assert!(error.to_string().contains("\"dept\"") && error.to_string().contains("object-ids"), "{error}");
}

#[test]
fn whoever_asks_gets() {
    for output in Output::ALL {
        let mut outputs = Outputs::NONE;
        output.ask_for(&mut outputs);
        let settings = RenderSettings { outputs, ..RenderSettings::new(8, 6) };
        let scene = showcase();
        let frame = render(&scene, &scene.overview(settings.aspect()), &settings).expect("drawn");
        encode_npy(Vec::new(), &frame, output).expect("the frame holds it");
    }
}

/// Positions of what is 10⁷ m away are relative to a point there: an array beside theirs and an attribute say which.
#[test]
fn the_origin_of_positions_is_said_beside_and_in_files() {
    let origin = trigon_math::DVec3::new(1e7, -0.1, 3e-9);
    let frame = Frame { origin, ..frame() };
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.npy");
    write_origin_npy(&path, &frame).expect("written");
    let bytes = std::fs::read(&path).expect("it is there");
    let text = String::from_utf8_lossy(&bytes[10..]).into_owned();
    assert!(text.contains("'<f8'") && text.contains("'shape': (3,)"), "{text}");
    let numbers = bytes[bytes.len() - 24..].as_chunks::<8>().0.iter().map(|bytes| f64::from_le_bytes(*bytes));
    assert_eq!(numbers.collect::<Vec<_>>(), origin.to_array(), "to the bit");
    let mut bytes = Vec::new();
    encode_exr(&mut bytes, &frame).expect("memory takes it");
    let said = b"P.origin\0string\0\x19\0\0\x0010000000 -0.1 0.000000003";
    assert!(bytes.windows(said.len()).any(|window| window == said), "a text attribute");
    bytes.clear();
    encode_exr(&mut bytes, &Frame { positions: None, ..frame }).expect("memory takes it");
    assert!(!bytes.windows(8).any(|window| window == b"P.origin"), "nothing without positions");
}
