//! The language of recorded sessions. One action or assertion in each line; `#` begins a comment:
//!
//! | line | does |
//! |---|---|
//! | `keys Tab 3 Ctrl+R` | presses keys one after the other |
//! | `type chair` | types a text |
//! | `hover X Y Z` | moves the pointer to where a place in the world is seen |
//! | `move DX DY` | moves it on by pixels |
//! | `click`, `click X Y Z`, `click X Y Z with Shift+Ctrl` | clicks where the pointer is, or at a place |
//! | `right click` | clicks with the right button where the pointer is |
//! | `drag X Y Z by DX DY`, `… with Alt`, `middle drag …` | drags from a place by pixels |
//! | `pull X by N` | drags the gizmo's arm of an axis outwards by pixels |
//! | `wheel N` | turns the wheel away from the user |
//! | `press Add` | clicks the first widget of this name |
//! | `scroll Alpha` | scrolls a panel until the first widget of this name is in view |
//! | `enter Intensity 250` | types a value into the field of this name |
//! | `see 1 of 6 faces selected` | asserts that a text of the interface contains this |
//! | `hidden Torus` | asserts that none is called so |
//! | `wait` | lets an image be rendered or written |
//! | `title *untitled - trigon` | asserts what is written on the window, once other threads have ended |
//! | `mesh Cube 8 12 6` | asserts vertices, edges and faces |
//! | `objects 2` | asserts how many there are |
//! | `image start` | writes what the window shows to a file of this name, if images are wanted |

use std::path::Path;

use trigon_window::egui::Role;
use trigon_window::scene::camera::{Projector, Viewport};
use trigon_window::scene::math::{DVec2, DVec3};
use trigon_window::{Chord, Key, Modifiers, PointerButton, Widget};

use super::{User, mesh};
use crate::tool::Axis;

impl User<'_> {
    /// Does what a script says, line by line.
    pub(in crate::window::tests) fn play(&mut self, script: &str) {
        for (line, number) in script.lines().zip(1..) {
            let action = line.split_once('#').map_or(line, |(action, _)| action).trim();
            if !action.is_empty() {
                self.act(&action.replace("$FOLDER", &self.folder.display().to_string()))
                    .unwrap_or_else(|error| panic!("line {number}, `{action}`: {error}"));
                self.image_of_line(number);
            }
        }
    }

    /// `TRIGON_IMAGES=folder` writes what the window shows after each line, to be looked at.
    fn image_of_line(&self, line: usize) {
        let Some(folder) = std::env::var_os("TRIGON_IMAGES") else { return };
        let thread = std::thread::current();
        let test = thread.name().and_then(|name| name.rsplit("::").next()).unwrap_or("session");
        self.write_image(&Path::new(&folder).join(format!("{test}_{line:03}.png")));
    }

    fn write_image(&self, path: &Path) {
        let Viewport { width, height } = self.window.stage().viewport();
        let pixels: Vec<u8> =
            self.window.pixels().into_iter().flat_map(|[r, g, b, _]| [r, g, b, 255]).collect();
        trigon_io::write_png(path, width, height, trigon_io::Pixels::Rgba8(&pixels))
            .expect("the folder exists");
    }

    fn act(&mut self, action: &str) -> Result<(), String> {
        let (verb, rest) = action.split_once(' ').unwrap_or((action, ""));
        match verb {
            "keys" => self.keys(rest)?,
            "type" => rest.chars().for_each(|typed| self.window.key(of_character(typed))),
            "hover" => self.hover(rest)?,
            "move" => self.move_by(place2(rest)?),
            "click" => self.click(rest)?,
            "right" => self.button(PointerButton::Right),
            "drag" => self.drag(rest, PointerButton::Left)?,
            "middle" => self.drag(rest.trim_start_matches("drag "), PointerButton::Middle)?,
            "pull" => self.pull(rest)?,
            "wheel" => self.window.wheel(number(rest)?),
            "press" => self.press(rest)?,
            "scroll" => self.scroll(rest)?,
            "wait" => self.wait_for_images(),
            "enter" => self.enter(rest)?,
            "image" => {
                if let Some(folder) = &self.images {
                    self.write_image(&folder.join(format!("{rest}.png")));
                }
            }
            _ => self.look(verb, rest)?,
        }
        Ok(())
    }

    fn look(&mut self, verb: &str, rest: &str) -> Result<(), String> {
        let shown = || self.window.all_widgets();
        let (seen, expected) = match verb {
            "see" => {
                let texts: Vec<_> = shown().into_iter().map(|widget| widget.label).collect();
                let is_visible = texts.iter().any(|text| text.contains(rest));
                return if is_visible { Ok(()) } else { Err(format!("there is only {texts:?}")) };
            }
            "hidden" => {
                let is_visible = shown().iter().any(|widget| widget.label == rest);
                return if is_visible { Err("it is there".into()) } else { Ok(()) };
            }
            "title" => {
                self.wait_for_title(rest);
                return Ok(());
            }
            "objects" => (self.editor.borrow().document.nodes().nodes().len().to_string(), rest.to_owned()),
            "mesh" => {
                let (name, counts) = rest.split_once(' ').ok_or("a name and three numbers")?;
                let editor = self.editor.borrow();
                let mesh = mesh(&editor.document, name);
                let [v, e, f] = [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()];
                (format!("{v} {e} {f}"), counts.to_owned())
            }
            _ => return Err("this is no action".into()),
        };
        if seen == expected {
            Ok(())
        } else {
            Err(format!("it is {seen}: {:?}", self.editor.borrow().message))
        }
    }

    fn keys(&mut self, chords: &str) -> Result<(), String> {
        for chord in chords.split_whitespace() {
            self.window.key(chord.parse().map_err(|error| format!("{error}"))?);
        }
        Ok(())
    }

    /// Where a place in the world is seen.
    fn seen(&self, place: DVec3) -> Result<DVec2, String> {
        let stage = self.window.stage();
        let panes = stage.panes();
        let pane = panes.iter().find(|pane| pane.side.is_none()).ok_or("no view is the camera's own")?;
        let projector = Projector::new(&stage.camera(), pane.area.size);
        let at = projector.to_screen(place).ok_or("it is behind the eye")?;
        Ok(at + pane.area.origin())
    }

    fn hover(&mut self, place: &str) -> Result<(), String> {
        let at = self.seen(place3(place)?)?;
        self.window.move_to(at);
        if self.window.is_on_interface() { Err(format!("a panel lies over {at}")) } else { Ok(()) }
    }

    fn move_by(&mut self, way: DVec2) {
        let to = self.editor.borrow().pointer.unwrap_or_default() + way;
        self.window.move_to(to);
    }

    fn click(&mut self, rest: &str) -> Result<(), String> {
        let (place, held) = with(rest)?;
        if !place.is_empty() {
            self.hover(place)?;
        }
        self.window.hold(held);
        self.button(PointerButton::Left);
        self.window.hold(Modifiers::NONE);
        Ok(())
    }

    fn button(&mut self, button: PointerButton) {
        self.window.press(button);
        self.window.release(button);
    }

    fn drag(&mut self, rest: &str, button: PointerButton) -> Result<(), String> {
        let (ways, held) = with(rest)?;
        let (from, way) = ways.split_once(" by ").ok_or("from where, and by how far?")?;
        let (from, way) = (place3(from)?, place2(way)?);
        let from = self.seen(from)?;
        self.window.move_to(from);
        self.window.hold(held);
        self.window.press(button);
        self.window.move_to(from + way);
        self.window.release(button);
        self.window.hold(Modifiers::NONE);
        Ok(())
    }

    fn pull(&mut self, rest: &str) -> Result<(), String> {
        /// Along an arm, from the middle.
        const GRIP: f64 = 60.0;
        let (axis, way) = rest.split_once(" by ").ok_or("which axis, and by how far?")?;
        let axis = axis.to_lowercase().chars().next().and_then(Axis::of_key).ok_or("no axis")?;
        let stage = self.window.stage();
        let pane = stage.pane_at(stage.viewport().size() * 0.5);
        let gizmo = self.editor.borrow_mut().gizmo(stage, &pane).ok_or("there is no gizmo")?;
        let arm = gizmo.axes.col(axis.index());
        let center = self.seen(gizmo.center)?;
        let direction = (self.seen(gizmo.center + arm)? - center).normalize();
        self.window.move_to(center + direction * GRIP);
        self.window.press(PointerButton::Left);
        self.window.move_to(center + direction * (GRIP + number(way)?));
        self.window.release(PointerButton::Left);
        Ok(())
    }

    fn widget(&self, label: &str, is_meant: impl Fn(&Widget) -> bool) -> Result<Widget, String> {
        let found = self.window.widgets(label).into_iter().find(is_meant);
        found.ok_or_else(|| {
            let all: Vec<_> = self.window.all_widgets().into_iter().map(|widget| widget.label).collect();
            format!("nothing of this name can be used: {all:?}")
        })
    }

    fn press(&mut self, label: &str) -> Result<(), String> {
        let widget = self.widget(label, |widget| !widget.is_disabled && widget.role != Role::Label)?;
        self.window.move_to(widget.center);
        self.button(PointerButton::Left);
        Ok(())
    }

    fn scroll(&mut self, label: &str) -> Result<(), String> {
        let height = self.window.stage().viewport().size().y;
        let in_view = 0.5 * height..height - 60.0;
        for _ in 0..100 {
            let at = self.widget(label, |_| true)?.center;
            if in_view.contains(&at.y) {
                return Ok(());
            }
            self.window.move_to(DVec2::new(at.x, 0.7 * height));
            self.window.wheel(if at.y < in_view.start { 1.0 } else { -1.0 });
        }
        Err("it does not come into view".into())
    }

    fn enter(&mut self, rest: &str) -> Result<(), String> {
        let (label, value) = rest.rsplit_once(' ').ok_or("a field and a value")?;
        let takes = [Role::SpinButton, Role::TextInput];
        let field = self.widget(label, |widget| takes.contains(&widget.role))?;
        self.window.move_to(field.center);
        self.button(PointerButton::Left);
        self.keys("Ctrl+A")?;
        value.chars().for_each(|typed| self.window.key(of_character(typed)));
        self.keys("Enter")
    }
}

fn of_character(typed: char) -> Chord {
    if typed == ' ' { Key::Space.into() } else { typed.into() }
}

/// What comes before `with`, and the modifiers after it.
fn with(text: &str) -> Result<(&str, Modifiers), String> {
    let Some((before, held)) = text.split_once("with ") else { return Ok((text, Modifiers::NONE)) };
    let chord: Chord = format!("{held}+A").parse().map_err(|error| format!("{error}"))?;
    Ok((before.trim(), chord.modifiers))
}

fn number(text: &str) -> Result<f64, String> {
    text.trim().parse().map_err(|_| format!("{text:?} is no number"))
}

fn numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let all: Vec<f64> = text.split_whitespace().map(number).collect::<Result<_, _>>()?;
    all.try_into().map_err(|_| format!("{text:?} should be {N} numbers"))
}

fn place2(text: &str) -> Result<DVec2, String> {
    numbers(text).map(DVec2::from_array)
}

fn place3(text: &str) -> Result<DVec3, String> {
    numbers(text).map(DVec3::from_array)
}
