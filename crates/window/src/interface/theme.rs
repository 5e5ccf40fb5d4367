//! Light and dark panels. Whatever can be chosen has a contrast of at least 4.5 : 1 to what lies behind it (WCAG 2.2,
//! success criterion 1.4.3); egui's own colours fall short for weak text, warnings and links.

use egui::{Color32, Context, Stroke, ThemePreference, Visuals};

use crate::theme::Theme;

/// Sets up the colours of both.
pub(super) fn set_colors(context: &Context) {
    context.set_visuals_of(egui::Theme::Dark, dark());
    context.set_visuals_of(egui::Theme::Light, light());
    // While nothing changes, nothing runs.
    context.all_styles_mut(|style| style.visuals.text_cursor.blink = false);
}

/// Shows one of them.
pub(super) fn choose(context: &Context, theme: Theme) {
    let wanted = match theme {
        Theme::System => ThemePreference::System,
        Theme::Dark => ThemePreference::Dark,
        Theme::Light => ThemePreference::Light,
    };
    context.set_theme(wanted);
}

fn dark() -> Visuals {
    let mut visuals = Visuals::dark();
    visuals.widgets.noninteractive.fg_stroke = Stroke::new(1.0, Color32::from_gray(205));
    visuals.weak_text_color = Some(Color32::from_gray(176));
    visuals.error_fg_color = Color32::from_rgb(255, 110, 100);
    visuals.warn_fg_color = Color32::from_rgb(255, 170, 90);
    visuals
}

fn light() -> Visuals {
    let mut visuals = Visuals::light();
    visuals.widgets.noninteractive.fg_stroke = Stroke::new(1.0, Color32::from_gray(50));
    visuals.weak_text_color = Some(Color32::from_gray(80));
    let pressed = Color32::from_gray(200);
    (visuals.widgets.active.weak_bg_fill, visuals.widgets.active.bg_fill) = (pressed, pressed);
    visuals.error_fg_color = Color32::from_rgb(176, 0, 0);
    visuals.warn_fg_color = Color32::from_rgb(140, 66, 0);
    visuals.hyperlink_color = Color32::from_rgb(0, 84, 160);
    visuals
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The relative luminance of WCAG 2.2, from its own formula.
    fn luminance(color: Color32) -> f64 {
        let linear = |byte: u8| {
            let value = f64::from(byte) / 255.0;
            if value <= 0.04045 {
                value / 12.92
            } else {
                trigon_math::elementary::pow((value + 0.055) / 1.055, 2.4)
            }
        };
        0.2126 * linear(color.r()) + 0.7152 * linear(color.g()) + 0.0722 * linear(color.b())
    }

    fn contrast(a: Color32, b: Color32) -> f64 {
        let (a, b) = (luminance(a), luminance(b));
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    #[test]
    fn everything_that_can_be_chosen_stands_out_in_both_themes() {
        for (theme, visuals) in [("dark", dark()), ("light", light())] {
            let Visuals { widgets, selection, panel_fill, extreme_bg_color, .. } = &visuals;
            let weak = visuals.weak_text_color.expect("it is set");
            let mut pairs = vec![
                ("selected", selection.stroke.color, selection.bg_fill),
                ("text", widgets.noninteractive.fg_stroke.color, *panel_fill),
                ("text in a field", widgets.inactive.fg_stroke.color, *extreme_bg_color),
                ("hint", weak, *extreme_bg_color),
                ("warning", visuals.warn_fg_color, *panel_fill),
                ("error", visuals.error_fg_color, *panel_fill),
                ("link", visuals.hyperlink_color, *panel_fill),
            ];
            let states = [
                ("inactive", widgets.inactive),
                ("hovered", widgets.hovered),
                ("active", widgets.active),
                ("open", widgets.open),
            ];
            for (state, look) in states {
                for behind in [look.weak_bg_fill, look.bg_fill, *panel_fill] {
                    pairs.push((state, look.fg_stroke.color, behind));
                }
                pairs.push(("shortcut", weak, look.weak_bg_fill));
            }
            for (what, color, behind) in pairs {
                let ratio = contrast(color, behind);
                assert!(ratio >= 4.5, "{theme}: {what} has {ratio:.2} : 1, {color:?} on {behind:?}");
            }
        }
        assert!((contrast(Color32::BLACK, Color32::WHITE) - 21.0).abs() < 1e-9, "the most that there is");
    }
}
