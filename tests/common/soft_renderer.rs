//! Draws egui on the CPU: no GPU, no driver, no display, and the same pixels on every computer.
//!
//! Blends as egui's own renderers do: gamma space, premultiplied alpha, bilinear sampling. Coverage is decided in fixed
//! point with the top-left rule, so that an edge shared by two triangles is drawn once.

use std::collections::HashMap;

use egui::epaint::{ImageDelta, Primitive, Vertex};
use egui::{ClippedPrimitive, Color32, TextureId, TexturesDelta};

/// Pixels with one more number each than they need, to stay exact while blending.
type Rgba = [f32; 4];

struct Texture {
    width: usize,
    height: usize,
    pixels: Vec<Color32>,
    nearest: bool,
}

#[derive(Default)]
pub struct SoftRenderer {
    textures: HashMap<TextureId, Texture>,
}

struct Canvas {
    width: usize,
    height: usize,
    pixels: Vec<Rgba>,
    scale: f32,
}

/// In pixels, the end excluded.
struct Clip {
    x: (i64, i64),
    y: (i64, i64),
}

/// Bits of the fixed-point fraction.
const FRACTION: i64 = 8;
const ONE: i64 = 1 << FRACTION;

impl SoftRenderer {
    fn update(&mut self, id: TextureId, delta: &ImageDelta) {
        let egui::ImageData::Color(image) = &delta.image;
        let [width, height] = image.size;
        match delta.pos {
            None => {
                let nearest = delta.options.magnification == egui::TextureFilter::Nearest;
                self.textures.insert(id, Texture { width, height, pixels: image.pixels.clone(), nearest });
            }
            Some([x, y]) => {
                let texture = self.textures.get_mut(&id).expect("a known texture");
                for row in 0..height {
                    texture.pixels[(y + row) * texture.width + x..][..width]
                        .copy_from_slice(&image.pixels[row * width..][..width]);
                }
            }
        }
    }

    fn draw(&self, canvas: &mut Canvas, primitive: &ClippedPrimitive) {
        let Primitive::Mesh(mesh) = &primitive.primitive else { panic!("paint callbacks cannot be drawn here") };
        let edge = |at: f32, most: usize| ((at * canvas.scale).round() as i64).clamp(0, most as i64);
        let rect = primitive.clip_rect;
        let clip = Clip {
            x: (edge(rect.min.x, canvas.width), edge(rect.max.x, canvas.width)),
            y: (edge(rect.min.y, canvas.height), edge(rect.max.y, canvas.height)),
        };
        let texture = &self.textures[&mesh.texture_id];
        for corners in mesh.indices.chunks_exact(3) {
            canvas.triangle([0, 1, 2].map(|i| mesh.vertices[corners[i] as usize]), texture, &clip);
        }
    }
}

impl Canvas {
    fn triangle(&mut self, mut corners: [Vertex; 3], texture: &Texture, clip: &Clip) {
        let fixed = |at: f32| (at * self.scale * ONE as f32).round() as i64;
        let mut at = corners.map(|v| (fixed(v.pos.x), fixed(v.pos.y)));
        let mut area = (at[1].0 - at[0].0) * (at[2].1 - at[0].1) - (at[1].1 - at[0].1) * (at[2].0 - at[0].0);
        if area == 0 {
            return;
        }
        if area < 0 {
            corners.swap(1, 2);
            at.swap(1, 2);
            area = -area;
        }
        let span = |values: [i64; 3], clip: (i64, i64)| {
            let [a, b, c] = values;
            ((a.min(b).min(c) >> FRACTION).max(clip.0), ((a.max(b).max(c) >> FRACTION) + 1).min(clip.1))
        };
        let (left, right) = span(at.map(|p| p.0), clip.x);
        let (top, bottom) = span(at.map(|p| p.1), clip.y);
        let edges = [(1, 2), (2, 0), (0, 1)].map(|(from, to)| Edge::new(at[from], at[to]));
        let colors = corners.map(|v| v.color.to_array().map(f32::from));
        let same = |f: &dyn Fn(&Vertex) -> bool| corners.iter().all(f);
        let flat_texel = same(&|v| v.uv == corners[0].uv).then(|| texture.sample(corners[0].uv.x, corners[0].uv.y));
        let flat_color = same(&|v| v.color == corners[0].color).then_some(colors[0]);
        for y in top..bottom {
            let py = (y << FRACTION) + ONE / 2;
            let (mut from, mut to) = (left, right);
            for edge in &edges {
                (from, to) = edge.narrow(py, from, to);
            }
            if from >= to {
                continue;
            }
            let row = y as usize * self.width;
            let pixels = &mut self.pixels[row + from as usize..row + to as usize];
            if let (Some(color), Some(texel)) = (flat_color, flat_texel) {
                fill(pixels, color, texel);
                continue;
            }
            for (x, pixel) in (from..to).zip(pixels) {
                let px = (x << FRACTION) + ONE / 2;
                let share = [0, 1, 2].map(|i| edges[i].at(px, py) as f32 / area as f32);
                let mix = |a: f32, b: f32, c: f32| a * share[0] + b * share[1] + c * share[2];
                let color =
                    flat_color.unwrap_or_else(|| [0, 1, 2, 3].map(|k| mix(colors[0][k], colors[1][k], colors[2][k])));
                let texel = flat_texel.unwrap_or_else(|| {
                    let [a, b, c] = corners;
                    texture.sample(mix(a.uv.x, b.uv.x, c.uv.x), mix(a.uv.y, b.uv.y, c.uv.y))
                });
                fill(std::slice::from_mut(pixel), color, texel);
            }
        }
    }
}

/// One side of a triangle, in fixed point.
struct Edge {
    from: (i64, i64),
    dx: i64,
    dy: i64,
    /// Keeps a pixel centre that lies exactly on the side out of one of the two triangles.
    bias: i64,
}

impl Edge {
    fn new(from: (i64, i64), to: (i64, i64)) -> Self {
        let (dx, dy) = (to.0 - from.0, to.1 - from.1);
        let is_top_left = dy < 0 || (dy == 0 && dx > 0);
        Self { from, dx, dy, bias: if is_top_left { 0 } else { -1 } }
    }

    /// Not negative inside.
    fn at(&self, px: i64, py: i64) -> i64 {
        self.dx * (py - self.from.1) - self.dy * (px - self.from.0) + self.bias
    }

    /// What of a row of pixels is inside.
    fn narrow(&self, py: i64, from: i64, to: i64) -> (i64, i64) {
        let first = self.at(ONE / 2, py);
        let step = self.dy * ONE;
        match step {
            0 if first < 0 => (from, from),
            0 => (from, to),
            1.. => (from, to.min(first.div_euclid(step) + 1)),
            _ => (from.max(-first.div_euclid(-step)), to),
        }
    }
}

/// Blends one colour over pixels.
fn fill(pixels: &mut [Rgba], color: Rgba, texel: Rgba) {
    let keep = 1.0 - color[3] * texel[3] / 255.0 / 255.0;
    let [r, g, b, a] = [0, 1, 2, 3].map(|k| color[k] * texel[k] / 255.0);
    for pixel in pixels {
        let [r0, g0, b0, a0] = *pixel;
        *pixel = [r + r0 * keep, g + g0 * keep, b + b0 * keep, a + a0 * keep];
    }
}

impl Texture {
    fn texel(&self, x: i64, y: i64) -> Rgba {
        let (x, y) = (x.clamp(0, self.width as i64 - 1), y.clamp(0, self.height as i64 - 1));
        self.pixels[y as usize * self.width + x as usize].to_array().map(f32::from)
    }

    fn sample(&self, u: f32, v: f32) -> Rgba {
        let (x, y) = (u * self.width as f32, v * self.height as f32);
        if self.nearest {
            return self.texel(x.floor() as i64, y.floor() as i64);
        }
        let (x, y) = (x - 0.5, y - 0.5);
        let (fx, fy) = (x - x.floor(), y - y.floor());
        let (x, y) = (x.floor() as i64, y.floor() as i64);
        let (a, b) = (self.texel(x, y), self.texel(x + 1, y));
        let (c, d) = (self.texel(x, y + 1), self.texel(x + 1, y + 1));
        std::array::from_fn(|k| (a[k] * (1.0 - fx) + b[k] * fx) * (1.0 - fy) + (c[k] * (1.0 - fx) + d[k] * fx) * fy)
    }
}

impl egui_kittest::TestRenderer for SoftRenderer {
    fn handle_delta(&mut self, delta: &mut TexturesDelta) {
        for (id, deltas) in std::mem::take(&mut delta.set) {
            for delta in deltas {
                self.update(id, &delta);
            }
        }
        for id in std::mem::take(&mut delta.free) {
            self.textures.remove(&id);
        }
    }

    fn render(&mut self, ctx: &egui::Context, output: &egui::FullOutput) -> Result<image::RgbaImage, String> {
        let scale = ctx.pixels_per_point();
        let size = ctx.content_rect().size() * scale;
        let (width, height) = (size.x.round() as usize, size.y.round() as usize);
        let mut canvas = Canvas { width, height, pixels: vec![[0.0; 4]; width * height], scale };
        for primitive in &ctx.tessellate(output.shapes.clone(), scale) {
            self.draw(&mut canvas, primitive);
        }
        let bytes = canvas.pixels.into_iter().flatten().map(|channel| (channel.min(255.0) + 0.5) as u8).collect();
        image::RgbaImage::from_raw(width as u32, height as u32, bytes).ok_or_else(|| "wrong size".into())
    }
}
