"""Reference values of the integral of 1/r over a rectangle, for tests/analytic.rs (mpmath, 60 digits).

Run: python3 rectangle_potential.py > rectangle_potential.csv
"""

from mpmath import asinh, mp, mpf

mp.dps = 60


def antiderivative(u, v):
    total = mpf(0)
    if u != 0:
        total += u * asinh(v / abs(u))
    if v != 0:
        total += v * asinh(u / abs(v))
    return total


def potential(x, y, a, b):
    x, y, a, b = (mpf(q) for q in (x, y, a, b))
    corner = antiderivative
    return corner(x + a, y + b) - corner(x + a, y - b) - corner(x - a, y + b) + corner(x - a, y - b)


def main():
    print("x,y,half_x,half_y,potential")
    rays = [(1.0, 0.0), (0.0, 1.0), (1.0, 1.0), (3.0, 1.0), (1.0, -40.0), (-1.0, 0.001)]
    # 8 and 50 half diagonals are the borders between the branches of the implementation
    ratios = [0.0, 0.25, 0.5, 1.0, 2.0, 3.5, 7.9, 8.2, 15.0, 23.0, 40.0, 49.5, 51.0, 250.0, 1e4]
    for a, b in [(0.5, 0.5), (0.5, 1.5), (2.5, 0.5), (1.0, 64.0), (1e-6, 1.25e-6)]:
        for ratio in ratios:
            for along, across in rays if ratio else rays[:1]:
                x, y = ratio * a * along, ratio * a * across
                print(f"{x!r},{y!r},{a!r},{b!r},{float(potential(x, y, a, b))!r}")


if __name__ == "__main__":
    main()
