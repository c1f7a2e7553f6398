//! Every colour and size of the window.

use egui::{Color32, Context, CornerRadius, FontFamily, FontId, Margin, Shadow, Stroke, TextStyle, Theme, Vec2, vec2};

/// The colours of one theme, by what they mean.
#[derive(Debug, Clone, Copy)]
pub struct Palette {
    pub background: Color32,
    pub panel: Color32,
    pub stripe: Color32,
    pub raised: Color32,
    pub line: Color32,
    pub text: Color32,
    pub weak: Color32,
    pub accent: Color32,
    pub on_accent: Color32,
    pub ok: Color32,
    pub warning: Color32,
    pub error: Color32,
    pub off: Color32,
    /// Lines of a plot, told apart by their hue; the first ones are used most.
    pub plot: [Color32; 8],
    /// Fill of tick boxes and radio buttons: must stand out from the panel also when it is not ticked.
    tick_box: Color32,
    selection: f32,
    shadow: u8,
}

const fn rgb(hex: u32) -> Color32 {
    let [_, r, g, b] = hex.to_be_bytes();
    Color32::from_rgb(r, g, b)
}

const DARK: Palette = Palette {
    background: rgb(0x16181d),
    panel: rgb(0x1d2027),
    stripe: rgb(0x1a1d23),
    raised: rgb(0x2a2e38),
    line: rgb(0x323744),
    text: rgb(0xe4e7ec),
    weak: rgb(0x9aa3b2),
    accent: rgb(0x3b7bf0),
    on_accent: Color32::WHITE,
    ok: rgb(0x3fb97f),
    warning: rgb(0xe5a73b),
    error: rgb(0xee6160),
    off: rgb(0x8b94a4),
    plot: [
        rgb(0x5b9bff),
        rgb(0xf2a33a),
        rgb(0x4fc98c),
        rgb(0xf06d8f),
        rgb(0xb28dff),
        rgb(0x3ec7d6),
        rgb(0xd9d05a),
        rgb(0xc8cedb),
    ],
    tick_box: rgb(0x667085),
    selection: 0.28,
    shadow: 110,
};

const LIGHT: Palette = Palette {
    background: rgb(0xffffff),
    panel: rgb(0xf4f5f8),
    stripe: rgb(0xf8f9fb),
    raised: rgb(0xffffff),
    line: rgb(0xd9dde5),
    text: rgb(0x1b1f27),
    weak: rgb(0x5b6473),
    accent: rgb(0x2563eb),
    on_accent: Color32::WHITE,
    ok: rgb(0x15803d),
    warning: rgb(0xb45309),
    error: rgb(0xc62828),
    off: rgb(0x6b7280),
    plot: [
        rgb(0x2563eb),
        rgb(0xc2570c),
        rgb(0x15803d),
        rgb(0xbe185d),
        rgb(0x7c3aed),
        rgb(0x0e7490),
        rgb(0x7a6a00),
        rgb(0x475569),
    ],
    tick_box: rgb(0xffffff),
    selection: 0.16,
    shadow: 45,
};

pub fn palette(ui: &egui::Ui) -> &'static Palette {
    if ui.visuals().dark_mode { &DARK } else { &LIGHT }
}

pub const MIN_WINDOW: [f32; 2] = [900.0, 500.0];
/// The window of [`super::show_notice`].
pub const NOTICE_WINDOW: [f32; 2] = [460.0, 240.0];
/// Above and below its button.
pub const NOTICE_SPACE: f32 = 8.0;
pub const DEFAULT_WINDOW: [f32; 2] = [1280.0, 800.0];

pub const ROW_HEIGHT: f32 = 32.0;
pub const HEADER_HEIGHT: f32 = 34.0;
/// Half the gap between two columns.
pub const COLUMN_EDGE: f32 = 5.0;
pub const TICK_COLUMN: f32 = 34.0;
pub const MIN_COLUMN: f32 = 60.0;
/// Initial widths of the columns, in their order.
pub const COLUMN_WIDTHS: [f32; 9] = [170.0, 110.0, 135.0, 115.0, 105.0, 175.0, 115.0, 80.0, 145.0];
pub const SEARCH_WIDTH: f32 = 320.0;
pub const BUTTON_HEIGHT: f32 = 28.0;
/// Of lines that follow closely on each other.
pub const DENSE_HEIGHT: f32 = 22.0;

pub const DIALOG: f32 = 520.0;
pub const DIALOG_WIDE: f32 = 680.0;
/// What a dialog leaves of the window's height for its own frame.
pub const DIALOG_MARGIN: f32 = 148.0;
/// Of the server log's window: its width, its lines' height, and what it leaves of the window's height.
pub const DIALOG_LOG: f32 = 980.0;
pub const LOG_HEIGHT: f32 = 520.0;
pub const LOG_MARGIN: f32 = 260.0;
/// The lists of whom a controller trusts: margin within, least height, and the width from which they lie side by side.
pub const TRUST_MARGIN: Margin = Margin::symmetric(10, 8);
/// What their dialog leaves of the window for itself and its surroundings.
pub const TRUST_ROOM: Vec2 = vec2(72.0, 168.0);
/// Below this height of the window, the details of the line under the cursor are shortened.
pub const TRUST_LOW_WINDOW: f32 = 640.0;
pub const TRUST_MIN_HEIGHT: f32 = 140.0;
pub const TRUST_SIDE_BY_SIDE: f32 = 1050.0;
/// Live values: a lamp with its number, the bar that shows a value in its range, the tree beside the attributes, and
/// the list beside the plot.
pub const LAMP: Vec2 = vec2(46.0, 40.0);
pub const LAMP_RADIUS: f32 = 7.0;
pub const RANGE_BAR: Vec2 = vec2(90.0, 6.0);
pub const NODE_TREE: f32 = 360.0;
pub const NODE_INDENT: f32 = 16.0;
pub const PLOT_LIST: f32 = 260.0;
pub const LIVE_MIN_HEIGHT: f32 = 160.0;
/// Plots of a recording, one above the other: the least height of each, and the width of the numbers beside it, so that all
/// begin at the same place.
pub const PLOT_MIN_HEIGHT: f32 = 110.0;
pub const PLOT_AXIS: f32 = 52.0;
/// What a recording is doing, in the table of recordings.
pub const RECORDING_STATE: f32 = 250.0;
/// The square in the colour of a line, beside its name.
pub const PLOT_MARK: f32 = 9.0;
/// What the tree and the plot leave of the dialog's height to what is above them.
pub const LIVE_ROOM: f32 = 262.0;
/// Remote control: what the tabs leave of the window's height to what is above them, the width of a lamp with a label
/// below its number, and the height of what stands around the log.
pub const REMOTE_ROOM: f32 = 390.0;
pub const LABELLED_LAMP: f32 = 84.0;
pub const LABEL_LINE: f32 = 14.0;
pub const LOG_TOOLS: f32 = 92.0;
/// Of the small CA's window, with its list of certificates.
pub const DIALOG_AUTHORITY: f32 = 960.0;
pub const LABEL_WIDTH: f32 = 150.0;
pub const LIST_HEIGHT: f32 = 10.0 * LIST_ROW;
pub const LIST_ROW: f32 = 26.0;

/// The details pane: its width at first, its least width, and what it leaves of the window to the table.
pub const DETAILS: f32 = 320.0;
pub const DETAILS_MIN: f32 = 220.0;
pub const DETAILS_LEAVES: f32 = 420.0;
pub const DETAILS_SPACING: f32 = 2.0;
/// The command palette: its width, and its distance from the upper edge of the window.
pub const PALETTE: f32 = 620.0;
pub const PALETTE_TOP: f32 = 60.0;

pub const SPACE: f32 = 8.0;
pub const SPACE_LARGE: f32 = 14.0;

pub const HEADER_TEXT: f32 = 12.5;
pub const SMALL_TEXT: f32 = 12.0;
pub const TITLE_TEXT: f32 = 18.0;
pub const WELCOME_TEXT: f32 = 22.0;

/// How strongly the colour of a chip fills it.
pub const CHIP_FILL: f32 = 0.16;
pub const CHIP_HEIGHT: f32 = 20.0;
pub const CHIP_DOT: f32 = 3.0;

pub const MENU_MARGIN: Margin = Margin::symmetric(10, 4);
pub const TOOLBAR_MARGIN: Margin = Margin::symmetric(14, 10);
pub const STATUS_MARGIN: Margin = Margin::symmetric(14, 6);
pub const CARD_MARGIN: Margin = Margin::same(12);
pub const SEARCH_MARGIN: Margin = Margin::symmetric(10, 6);
const SPACING: Vec2 = vec2(8.0, 6.0);

/// Sets both themes; which one is shown is the engineer's or the system's choice.
pub fn install(ctx: &Context) {
    for (theme, palette) in [(Theme::Dark, &DARK), (Theme::Light, &LIGHT)] {
        ctx.style_mut_of(theme, |style| {
            style.text_styles = [
                (TextStyle::Heading, FontId::new(TITLE_TEXT, FontFamily::Proportional)),
                (TextStyle::Body, FontId::new(14.0, FontFamily::Proportional)),
                (TextStyle::Button, FontId::new(14.0, FontFamily::Proportional)),
                (TextStyle::Small, FontId::new(SMALL_TEXT, FontFamily::Proportional)),
                (TextStyle::Monospace, FontId::new(13.0, FontFamily::Monospace)),
            ]
            .into();
            let spacing = &mut style.spacing;
            spacing.item_spacing = SPACING;
            spacing.button_padding = vec2(12.0, 5.0);
            spacing.interact_size.y = BUTTON_HEIGHT;
            spacing.menu_margin = Margin::same(6);
            spacing.window_margin = Margin::same(18);
            spacing.icon_width = 16.0;
            spacing.combo_height = 280.0;
            // Rows take the clicks.
            style.interaction.selectable_labels = false;
            style.animation_time = 0.08;
            visuals(&mut style.visuals, theme, palette);
        });
    }
}

fn visuals(visuals: &mut egui::Visuals, theme: Theme, palette: &Palette) {
    visuals.panel_fill = palette.panel;
    visuals.window_fill = if theme == Theme::Dark { palette.panel } else { palette.background };
    visuals.extreme_bg_color = palette.background;
    visuals.faint_bg_color = palette.stripe;
    visuals.window_stroke = Stroke::new(1.0, palette.line);
    visuals.window_corner_radius = CornerRadius::same(10);
    visuals.menu_corner_radius = CornerRadius::same(8);
    visuals.window_shadow =
        Shadow { offset: [0, 8], blur: 28, spread: 0, color: Color32::from_black_alpha(palette.shadow) };
    visuals.popup_shadow = visuals.window_shadow;
    visuals.selection.bg_fill = palette.accent.gamma_multiply(palette.selection);
    // Also the outline of the text field that has the keyboard.
    visuals.selection.stroke = Stroke::new(1.5, palette.accent);
    visuals.weak_text_color = Some(palette.weak);
    visuals.warn_fg_color = palette.warning;
    visuals.error_fg_color = palette.error;
    visuals.hyperlink_color = palette.accent;
    let widgets = &mut visuals.widgets;
    widgets.noninteractive.fg_stroke = Stroke::new(1.0, palette.text);
    widgets.noninteractive.bg_stroke = Stroke::new(1.0, palette.line);
    widgets.noninteractive.bg_fill = palette.panel;
    let states = [
        (&mut widgets.inactive, false),
        (&mut widgets.hovered, true),
        (&mut widgets.active, true),
        (&mut widgets.open, true),
    ];
    for (widget, engaged) in states {
        widget.corner_radius = CornerRadius::same(6);
        widget.expansion = 0.0;
        widget.fg_stroke = Stroke::new(if engaged { 1.5 } else { 1.0 }, palette.text);
        widget.bg_stroke = Stroke::new(1.0, if engaged { palette.accent.gamma_multiply(0.7) } else { palette.line });
        widget.weak_bg_fill = if engaged { palette.raised.lerp_to_gamma(palette.accent, 0.12) } else { palette.raised };
        widget.bg_fill = palette.tick_box;
    }
}

/// The look of rows in a table or list: the text of a selected row stays readable, and the row under the mouse has the
/// soft fill of a button there, not the strong one of a tick box.
pub fn style_rows(ui: &mut egui::Ui) {
    let text = palette(ui).text;
    let visuals = ui.visuals_mut();
    visuals.selection.stroke.color = text;
    visuals.widgets.hovered.bg_fill = visuals.widgets.hovered.weak_bg_fill;
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance and contrast ratio, WCAG 2.2.
    fn contrast(a: Color32, b: Color32) -> f32 {
        let luminance = |color: Color32| {
            let [r, g, b] = [color.r(), color.g(), color.b()].map(egui::ecolor::linear_f32_from_gamma_u8);
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        let (a, b) = (luminance(a), luminance(b));
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    #[test]
    fn a_row_under_the_mouse_stays_readable() {
        for palette in [LIGHT, DARK] {
            let hovered = palette.raised.lerp_to_gamma(palette.accent, 0.12);
            assert!(contrast(palette.text, hovered) >= 7.0 && contrast(palette.weak, hovered) >= 4.5, "{hovered:?}");
        }
    }

    #[test]
    fn an_unticked_box_stands_out_in_the_dark_theme() {
        for under in [DARK.background, DARK.panel, DARK.stripe] {
            assert!(contrast(DARK.tick_box, under) >= 3.0, "{under:?}");
        }
        assert!(contrast(DARK.text, DARK.tick_box) >= 3.0, "the tick in it");
    }
}
