//! `--outputs`: depth, ids and positions beside the image, as NumPy arrays or in EXR.

use std::fs;

use crate::{Folder, array, png_size};

#[test]
fn outputs_are_written_next_to_the_image_or_in_it() {
    let folder = Folder::new();
    let draw = "corner.obj --resolution 30,20 --view=front";
    let said = folder.said(&format!("{draw} --output o.png --outputs depth,object-ids,depth.png"), 0);
    let names = ["o.png", "o.depth.npy", "o.object-ids.npy", "o.depth.png"];
    let lines = names.map(|name| format!("trigon-viewer: wrote {name} (30×20)\n"));
    assert_eq!(said, lines.concat(), "a line for each file");
    let (depths, ids) = (array(&folder.path("o.depth.npy")), array(&folder.path("o.object-ids.npy")));
    let millimetres = fs::read(folder.path("o.depth.png")).expect("written");
    assert_eq!((depths.len(), ids.len(), png_size(&millimetres)), (2400, 2400, (30, 20)), "all pixels");
    let number = |bytes: &[u8], x: usize, y: usize| {
        let at = 4 * (y * 30 + x);
        u32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes"))
    };
    assert_eq!([number(&ids, 0, 0), number(&ids, 15, 10)], [u32::MAX, 0], "background and model");
    assert_eq!(f32::from_bits(number(&depths, 0, 0)), f32::INFINITY, "background");
    assert!((0.5..10.0).contains(&f32::from_bits(number(&depths, 15, 10))), "metres");

    let said = folder.said(&format!("{draw} --output o.exr --outputs depth,normals"), 0);
    assert_eq!(said, "trigon-viewer: wrote o.exr (30×20)\n", "one file");
    let bytes = fs::read(folder.path("o.exr")).expect("written");
    for word in [&b"N.X\0"[..], b"Z\0", b"A\0"] {
        assert!(bytes.windows(word.len()).any(|window| window == word), "the channel {word:?}");
    }
}

/// A plate of 2 m, 10⁶ and 10⁷ m away: f32 in the world would round its positions to 6 cm and to a metre. Seen straight
/// from the front by parallel rays they are as far apart as pixels are.
#[test]
fn positions_far_away_are_relative_to_an_origin_that_is_said() {
    let folder = Folder::new();
    for far in [1e6, 1e7] {
        let corner = |x: f64, y: f64| format!("v {} {} {}\n", far + x, y - far, 0.25 * far);
        let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)].concat();
        folder.write("plate.obj", &format!("{corners}f 1 2 3 4\n"));
        let draw = "plate.obj --view=front --camera-orthographic --resolution 40,40 --outputs positions";
        let said = folder.said(&format!("{draw} --output o.png"), 0);
        assert!(said.contains("wrote o.positions-origin.npy (add it to the positions: "), "{said}");
        let bytes = array(&folder.path("o.positions-origin.npy"));
        let origin: Vec<f64> =
            bytes.as_chunks::<8>().0.iter().map(|number| f64::from_le_bytes(*number)).collect();
        let bytes = array(&folder.path("o.positions.npy"));
        let numbers: Vec<f32> =
            bytes.as_chunks::<4>().0.iter().map(|number| f32::from_le_bytes(*number)).collect();
        let middle = [far, -far, 0.25 * far];
        let at = |x: usize, y: usize| {
            [0, 1, 2].map(|axis| origin[axis] + f64::from(numbers[3 * (40 * y + x) + axis]) - middle[axis])
        };
        let pixel = at(20, 20)[0] - at(19, 20)[0];
        assert!((0.05..0.06).contains(&pixel), "the plate fills nine tenths of 40 pixels: {pixel} m");
        for (x, y) in (4..36).flat_map(|x| (4..36).map(move |y| (x, y))) {
            let expected = [(x as f64 - 19.5) * pixel, (19.5 - y as f64) * pixel, 0.0];
            let off = [0, 1, 2].map(|axis| (at(x, y)[axis] - expected[axis]).abs());
            // What is left of f32 within 4 m of the origin, and of f64 at 10⁷ m, up to 20 times.
            assert!(off.iter().all(|off| *off < 1e-5), "{off:?} at {x}, {y} of {far}");
        }
        folder.said(&format!("{draw} --output o.exr"), 0);
        let word = format!("{} {} {}", origin[0], origin[1], origin[2]);
        let bytes = fs::read(folder.path("o.exr")).expect("written");
        assert!(bytes.windows(word.len()).any(|window| window == word.as_bytes()), "{word} in o.exr");
        let printed = folder.run(&format!("{draw} --output p.png --json")).stdout;
        let facts: serde_json::Value = serde_json::from_slice(&printed).expect("a line of JSON");
        assert_eq!(facts["positions_origin"], serde_json::json!(origin), "the same");
    }
    let said = folder.said("corner.obj --resolution 30,20 --output n.png --outputs positions", 0);
    assert!(
        said.contains("(add it to the positions: 0, 0, 0)"),
        "near the origin they are the world's: {said}"
    );
}

#[test]
fn an_output_that_does_not_fit_its_format_is_refused() {
    let folder = Folder::new();
    let far = "corner.obj --output o.png --resolution 20,20 --verbose=warning --camera-position=90,50,90 --camera-view-angle=1";
    let said = folder.failed(&format!("{far} --outputs depth.png"));
    assert!(said.contains("o.depth.png: ") && said.contains("65.535 m"), "{said}");
    folder.said(&format!("{far} --outputs depth"), 0);
    let said = folder.said(&format!("{far} --outputs uvs.png"), 2);
    assert!(said.contains("uvs.npy"), "16 bits say nothing of it, and that is known before drawing: {said}");
}
