// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/texture.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "core/common/random.hpp"

namespace foretrack {
namespace {

constexpr int kLongestSide_log2 = 10;
constexpr int kSide_px = 256;  // of procedural textures

int nearest_log2(int side_px) {
  const double log = std::log2(static_cast<double>(side_px));
  return std::clamp(static_cast<int>(std::lround(log)), 0, kLongestSide_log2);
}

std::uint32_t packed(const std::uint8_t* rgb) {
  return static_cast<std::uint32_t>(rgb[0] | rgb[1] << 8 | rgb[2] << 16);
}

std::uint32_t mean(std::array<std::uint32_t, 4> texels) {
  std::uint32_t result = 0;
  for (const int shift : {0, 8, 16}) {
    std::uint32_t sum = 2;
    for (const std::uint32_t t : texels) sum += t >> shift & 0xff;
    result |= sum / 4 << shift;
  }
  return result;
}

// The next level, half as wide and high (a side of 1 stays).
void add_half(Texture& texture) {
  const Texture::Level from = texture.levels.back();
  const Texture::Level to{std::max(from.width_log2 - 1, 0), std::max(from.height_log2 - 1, 0),
                          texture.texels.size()};
  const int dx = from.width_log2 > 0 ? 1 : 0, dy = from.height_log2 > 0 ? 1 : 0;
  for (int y = 0; y < 1 << to.height_log2; ++y)
    for (int x = 0; x < 1 << to.width_log2; ++x) {
      const auto at = [&](int column, int row) {
        const auto offset = static_cast<std::size_t>(row) << from.width_log2;
        return texture.texels[from.first + offset + column];
      };
      const int u = x << dx, v = y << dy;
      texture.texels.push_back(mean({at(u, v), at(u + dx, v), at(u, v + dy), at(u + dx, v + dy)}));
    }
  texture.levels.push_back(to);
}

struct Colour {
  double red, green, blue;
};

// A picture under the brush. Noise is smooth and repeats with the picture.
struct Painter {
  RgbImage image{kSide_px, kSide_px, std::vector<std::uint8_t>(3UL * kSide_px * kSide_px)};
  Random random;
  std::vector<double> lattice;

  explicit Painter(std::uint64_t seed) : random(seed), lattice(kSide_px * kSide_px) {
    for (double& value : lattice) value = random.uniform(-1.0, 1.0);
  }
  double lattice_at(int x, int y, int cells) const {
    return lattice[(y & (cells - 1)) * kSide_px + (x & (cells - 1))];
  }
  // Between −1 and 1, with `cells` (a power of two) bumps along a side.
  double noise(int x, int y, int cells) const {
    const double u = static_cast<double>(x) * cells / kSide_px,
                 v = static_cast<double>(y) * cells / kSide_px;
    const int i = static_cast<int>(u), j = static_cast<int>(v);
    const double a = u - i, b = v - j;
    const double s = a * a * (3.0 - 2.0 * a), t = b * b * (3.0 - 2.0 * b);
    return (1.0 - t) * ((1.0 - s) * lattice_at(i, j, cells) + s * lattice_at(i + 1, j, cells)) +
           t * ((1.0 - s) * lattice_at(i, j + 1, cells) + s * lattice_at(i + 1, j + 1, cells));
  }
  double clouds(int x, int y) const {
    return 0.5 * noise(x, y, 4) + 0.3 * noise(x, y, 16) + 0.3 * noise(x, y, 64) +
           0.2 * noise(x, y, 256);
  }
  template <class Brush>
  void paint(Brush brush) {
    for (int y = 0; y < kSide_px; ++y)
      for (int x = 0; x < kSide_px; ++x) {
        const Colour c = brush(x, y);
        std::uint8_t* rgb = image.pixel(x, y);
        for (const double value : {c.red, c.green, c.blue})
          *rgb++ = static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0));
      }
  }
};

Colour shaded(const Colour& colour, double factor) {
  return {colour.red * factor, colour.green * factor, colour.blue * factor};
}

// Stones in rows, every second row shifted; `joint` texels between them.
Colour bricks(const Painter& p, int x, int y, int wide, int high, int joint, const Colour& stone,
              const Colour& mortar, double spread) {
  const int row = y / high;
  const int shifted = (x + (row % 2 ? wide / 2 : 0)) % kSide_px;
  if (y % high < joint || shifted % wide < joint)
    return shaded(mortar, 1.0 + 0.15 * p.clouds(x, y));
  const double own = p.lattice_at(shifted / wide + 7 * row, row, 256);
  return shaded(stone, 1.0 + spread * own + 0.15 * p.clouds(x, y));
}

// A wall with a window in every tile.
Colour facade(const Painter& p, int x, int y) {
  const int row = kSide_px - 1 - y;  // from the ground up
  const bool frame = x > 88 && x < 168 && row > 72 && row < 180;
  const bool glass = x > 94 && x < 162 && row > 78 && row < 174 && std::abs(x - 128) > 2;
  if (glass) return shaded({70, 86, 100}, 1.0 + 0.25 * p.noise(x, y, 4) + 0.001 * row);
  if (frame) return {226, 222, 212};
  const double dirt = row < 24 ? 0.75 : 1.0;
  return shaded({214, 196, 160}, dirt * (1.0 + 0.10 * p.clouds(x, y)));
}

Colour colour_of(const Painter& p, Surface surface, int x, int y) {
  switch (surface) {
    case Surface::kPaving:
      return bricks(p, x, y, 32, 32, 1, {142, 138, 132}, {104, 101, 97}, 0.06);
    case Surface::kBrick:
      return bricks(p, x, y, 32, 10, 2, {150, 82, 62}, {176, 168, 156}, 0.18);
    case Surface::kPlaster:
      return facade(p, x, y);
    case Surface::kConcrete:
      return shaded({158, 156, 150}, 1.0 + 0.16 * p.clouds(x, y) - (y % 128 < 2 ? 0.2 : 0.0));
    case Surface::kLeaves:
      return shaded({64, 104, 48}, 1.0 + 0.45 * p.noise(x, y, 64) + 0.3 * p.noise(x, y, 256));
    case Surface::kRoof:
      break;
  }
  return shaded({112, 108, 106}, 1.0 + 0.12 * p.clouds(x, y));
}

}  // namespace

Texture make_texture(const RgbImage& image) {
  if (image.width_px < 1 || image.height_px < 1)
    throw std::invalid_argument("make_texture: the image is empty");
  const Texture::Level finest{nearest_log2(image.width_px), nearest_log2(image.height_px), 0};
  Texture texture{{finest}, {}};
  const int width = 1 << finest.width_log2, height = 1 << finest.height_log2;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int row = static_cast<int>((height - 1 - y + 0.5) * image.height_px / height);
      const int column = static_cast<int>((x + 0.5) * image.width_px / width);
      texture.texels.push_back(packed(image.pixel(column, row)));
    }
  while (texture.levels.back().width_log2 > 0 || texture.levels.back().height_log2 > 0)
    add_half(texture);
  return texture;
}

Texture make_surface_texture(Surface surface) {
  Painter painter(31 + static_cast<std::uint64_t>(surface));
  painter.paint([&](int x, int y) { return colour_of(painter, surface, x, y); });
  return make_texture(painter.image);
}

}  // namespace foretrack
