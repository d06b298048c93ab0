#include "engine/measure/flip_color.h"

#include <cmath>
#include <cstddef>

namespace raylab::flip {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

/// sRGB's primaries under D65 as the authors' program has them; rounding them otherwise moves FLIP in the 5th digit.
constexpr Matrix kXyzFromRgb = {{{10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
                                 {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
                                 {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0}}};

/// Rows that sum to 1: white has X = Y = Z = 1.
constexpr Matrix whiteRelative(Matrix m) {
    for (auto& row : m) {
        const double white = row[0] + row[1] + row[2];
        for (double& entry : row) entry /= white;
    }
    return m;
}

constexpr Matrix inverse(const Matrix& m) {
    Matrix cofactors{};
    for (size_t r = 0; r < 3; ++r)
        for (size_t c = 0; c < 3; ++c)
            cofactors[r][c] = m[(r + 1) % 3][(c + 1) % 3] * m[(r + 2) % 3][(c + 2) % 3] -
                              m[(r + 1) % 3][(c + 2) % 3] * m[(r + 2) % 3][(c + 1) % 3];
    const double determinant = m[0][0] * cofactors[0][0] + m[0][1] * cofactors[0][1] + m[0][2] * cofactors[0][2];
    Matrix result{};
    for (size_t r = 0; r < 3; ++r)
        for (size_t c = 0; c < 3; ++c) result[r][c] = cofactors[c][r] / determinant;
    return result;
}

using MatrixF = std::array<std::array<float, 3>, 3>;

constexpr MatrixF rounded(const Matrix& m) {
    MatrixF result{};
    for (size_t r = 0; r < 3; ++r)
        for (size_t c = 0; c < 3; ++c) result[r][c] = static_cast<float>(m[r][c]);
    return result;
}

constexpr MatrixF kToXyz = rounded(whiteRelative(kXyzFromRgb));
constexpr MatrixF kToRgb = rounded(inverse(whiteRelative(kXyzFromRgb)));

Color multiply(const MatrixF& m, const Color& v) {
    Color result{};
    for (size_t r = 0; r < 3; ++r) result[r] = m[r][0] * v[0] + m[r][1] * v[1] + m[r][2] * v[2];
    return result;
}

/// f of L*a*b* (CIE 15).
float labCurve(float value) {
    constexpr float kDelta = 6.0f / 29.0f;
    return value > kDelta * kDelta * kDelta ? std::cbrt(value) : value / (3.0f * kDelta * kDelta) + 4.0f / 29.0f;
}

float hyabPower(const Color& a, const Color& b) {
    const float distance = std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
    return std::pow(distance, 0.7f);
}

}  // namespace

Color whiteRelativeXyz(const Color& linearRgb) { return multiply(kToXyz, linearRgb); }

Color linearRgb(const Color& whiteRelativeXyz) { return multiply(kToRgb, whiteRelativeXyz); }

Color huntLab(const Color& whiteRelativeXyz) {
    const float x = labCurve(whiteRelativeXyz[0]), y = labCurve(whiteRelativeXyz[1]), z = labCurve(whiteRelativeXyz[2]);
    const float lightness = 116.0f * y - 16.0f;
    return {lightness, 0.01f * lightness * 500.0f * (x - y), 0.01f * lightness * 200.0f * (y - z)};
}

float colorError(const Color& a, const Color& b) {
    static const float largest =
        hyabPower(huntLab(whiteRelativeXyz({0.0f, 1.0f, 0.0f})), huntLab(whiteRelativeXyz({0.0f, 0.0f, 1.0f})));
    constexpr float kKneeError = 0.95f;
    const float knee = 0.4f * largest;
    const float power = hyabPower(a, b);
    return power < knee ? power * (kKneeError / knee)
                        : kKneeError + (power - knee) / (largest - knee) * (1.0f - kKneeError);
}

}  // namespace raylab::flip
