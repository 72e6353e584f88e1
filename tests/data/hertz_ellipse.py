"""Elliptical Hertz contacts for tests/analytic.rs, from mpmath's elliptic integrals (40 digits) with Johnson's formulas.

Run: python3 hertz_ellipse.py
"""

from mpmath import cbrt, ellipe, ellipk, findroot, mp, mpf, pi

mp.dps = 40


def contact(radius_x, radius_y, modulus, load):
    """Semi-axes (long, short), maximum pressure, approach; radius_x >= radius_y; E* = modulus / 2."""
    rx, ry, star, load = mpf(radius_x), mpf(radius_y), mpf(modulus) / 2, mpf(load)

    def mismatch(k):
        m = 1 - k * k
        return (ellipe(m) / k**2 - ellipk(m)) / (ellipk(m) - ellipe(m)) - rx / ry

    k = findroot(mismatch, (mpf(rx / ry) ** -1 + mpf("1e-30"), mpf(rx / ry) ** mpf("-0.5")), solver="anderson")
    m = 1 - k * k
    # A = 1/(2 Rx) = (p0/E*) (b/(e^2 a^2)) (K - E), p0 = 3 W/(2 pi a b)
    a = cbrt(2 * rx * 3 * load / (2 * pi * star) * (ellipk(m) - ellipe(m)) / m)
    b = k * a
    p0 = 3 * load / (2 * pi * a * b)
    return a, b, p0, p0 / star * b * ellipk(m)


if __name__ == "__main__":
    for rx, ry in [("0.015", "0.010"), ("0.020", "0.010"), ("0.1", "0.010"), ("10", "0.010")]:
        print(rx, ry, *(mp.nstr(v, 17) for v in contact(rx, ry, "230e9", "50")))
