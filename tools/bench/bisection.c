/* The yardstick of the bench: what `solve` finds, by bisection, in C.
 *
 * One function for one pair of tensions, one that loops over many. The equations are those of
 * docs/model.md, N_f in the form that is usual for N_f = (T² − W²) / (B + R); what depends on the
 * design alone is worked out once, and nothing is checked that a caller could not get wrong.
 *
 * What is halved is g itself, or with -DHALVED=quartic the quartic that has its sign, as in `solve`.
 */
#include <math.h>
#include <stddef.h>

#define TOLERANCE 1e-10
#define NARROW 1e-8
#define KNOTS 6
#ifndef HALVED
#define HALVED equation
#endif
#define JOINED(a, b) a##b
#define HALVE(of) JOINED(halve_, of)

enum { EQUILIBRIUM, HELD, SLIPPING, DRIVEN_TO_STOP, SLACK, INVALID = -1 };

typedef struct {
    double friction, weight, cable_gain, weight_gain, sine, cosine, stop, area, beta;
    int knot_count;
    double knots[KNOTS];
} Design;

typedef struct {
    double total, offset, gain, weight, product;
} Pair;

typedef struct {
    double angle, moment, force, root, direction;
} Point;

typedef struct {
    double bend_angle, pressure, normal_force, residual;
    double pressure_x, pressure_z, friction_x, friction_z, remainder_x, remainder_z;
    double angle_by_l, angle_by_s, pressure_by_l, pressure_by_s;
    signed char regime, root_count, iterations, stable, branch_consistent;
} Answer;

void prepare(Design *d, double r, double offset, double l, double m, double friction,
             double start, double end, double stop, double g, double width)
{
    d->friction = friction;
    d->weight = m * g;
    d->cable_gain = (r + offset) / (friction * r);
    d->weight_gain = d->weight * l / (friction * r);
    d->beta = 0.5 * (start + end);
    d->sine = sin(d->beta);
    d->cosine = cos(d->beta);
    d->stop = stop;
    d->area = 2.0 * r * sin(0.5 * (end - start)) * width;
    double turns[2] = {M_PI_2 - d->beta, M_PI - d->beta};
    d->knot_count = 0;
    d->knots[d->knot_count++] = 0.0;
    for (int i = 0; i < 2; i++)
        if (turns[i] > 0.0 && turns[i] < stop)
            d->knots[d->knot_count++] = turns[i];
    d->knots[d->knot_count++] = stop;
}

static inline Point at(const Design *d, const Pair *p, double angle)
{
    double s = sin(angle), c = cos(angle);
    double b = 1.0 - d->friction * p->weight * (d->sine * c + d->cosine * s);
    double square = b * b - (1.0 - d->friction * d->friction) * p->product;
    double root = sqrt(square > 0.0 ? square : 0.0);
    Point q = {angle, p->offset + p->gain * s, p->product / (b + root), root,
               (d->cosine * c - d->sine * s) / c};
    return q;
}

static inline double g(const Design *d, const Pair *p, double angle)
{
    Point q = at(d, p, angle);
    return q.moment - q.force;
}

/* Count the roots between two points, and keep the first bracket. */
static void search(const Design *d, const Pair *p, Point left, Point right, int *count,
                   double bracket[2])
{
    if (fmax(left.moment, right.moment) < fmin(left.force, right.force) ||
        fmin(left.moment, right.moment) > fmax(left.force, right.force))
        return;
    double at_left = d->friction * p->weight * left.force / left.root;
    double at_right = d->friction * p->weight * right.force / right.root;
    double a = at_left * left.direction, b = at_left * right.direction;
    double e = at_right * left.direction, f = at_right * right.direction;
    int monotonic = fmax(fmax(a, b), fmax(e, f)) < p->gain ||
                    fmin(fmin(a, b), fmin(e, f)) > p->gain;
    if (monotonic || right.angle - left.angle < NARROW) {
        double before = left.moment - left.force, after = right.moment - right.force;
        if ((before < 0.0 && after >= 0.0) || (before > 0.0 && after <= 0.0)) {
            if (!(*count)++) {
                bracket[0] = left.angle;
                bracket[1] = right.angle;
            }
        }
        return;
    }
    Point middle = at(d, p, 0.5 * (left.angle + right.angle));
    search(d, p, left, middle, count, bracket);
    search(d, p, middle, right, count, bracket);
}

/* Halve a bracket of g; return how often. */
static inline int halve_equation(const Design *d, const Pair *p, double *low, double *high)
{
    int iterations = 0, rising = g(d, p, *low) < 0.0;
    while (*high - *low > TOLERANCE) {
        double middle = 0.5 * (*low + *high);
        if ((g(d, p, middle) < 0.0) == rising)
            *low = middle;
        else
            *high = middle;
        iterations++;
    }
    return iterations;
}

/* The same in tan(θ/2), with the quartic. */
static inline int halve_quartic(const Design *d, const Pair *p, double *low, double *high)
{
    double square = (d->friction - 1.0) * (d->friction + 1.0), twice = 2.0 * p->gain;
    double standing = 2.0 * d->friction * p->weight * d->sine;
    double middle = 2.0 + square * p->offset, h0 = middle - standing, h2 = middle + standing;
    double h1 = square * twice - 4.0 * d->friction * p->weight * d->cosine;
    double c0 = p->product - p->offset * h0, c1 = -p->offset * h1 - twice * h0;
    double c2 = 2.0 * (p->product - p->offset * middle) - twice * h1;
    double c3 = -p->offset * h1 - twice * h2, c4 = p->product - p->offset * h2;
    double left = tan(0.5 * *low), right = tan(0.5 * *high);
    int positive = (((c4 * left + c3) * left + c2) * left + c1) * left + c0 >= 0.0, iterations;
    frexp(2.0 * (right - left) / TOLERANCE, &iterations);
    for (int i = 0; i < iterations; i++) {
        double t = 0.5 * (left + right);
        if (((((c4 * t + c3) * t + c2) * t + c1) * t + c0 > 0.0) == positive)
            left = t;
        else
            right = t;
    }
    *low = fmax(*low, 2.0 * atan(left));
    *high = fmin(*high, 2.0 * atan(right));
    return iterations > 0 ? iterations : 0;
}

/* Angle, pressure and what comes with them; returns the pair for `complete`. */
static inline Pair solve(const Design *d, double tension_l, double tension_s, Answer *a)
{
    Pair p = {tension_l + tension_s, 0.0, 0.0, 0.0, 0.0};
    a->root_count = a->iterations = a->stable = a->branch_consistent = 0;
    a->bend_angle = a->pressure = a->normal_force = a->residual = NAN;
    a->regime = INVALID;
    if (!(tension_l >= 0.0 && tension_s >= 0.0 && tension_l <= 1e9 && tension_s <= 1e9))
        return p;
    a->regime = SLACK;
    if (tension_l == 0.0 || tension_s == 0.0)
        return p;
    a->regime = INVALID;
    if (!(p.total > d->weight))
        return p;
    p.offset = fabs(tension_s - tension_l) / p.total * d->cable_gain;
    p.gain = d->weight_gain / p.total;
    p.weight = d->weight / p.total;
    p.product = (1.0 - p.weight) * (1.0 + p.weight);

    Point first = at(d, &p, d->knots[0]), left = first, answer;
    int count = 0;
    double bracket[2];
    for (int i = 1; i < d->knot_count; i++) {
        Point right = at(d, &p, d->knots[i]);
        search(d, &p, left, right, &count, bracket);
        left = right;
    }
    if (count) {
        double low = bracket[0], high = bracket[1];
        a->iterations = HALVE(HALVED)(d, &p, &low, &high);
        double at_low = g(d, &p, low), at_high = g(d, &p, high);
        answer = at(d, &p, high - at_high * (high - low) / (at_high - at_low));
        a->regime = EQUILIBRIUM;
        a->stable = answer.direction * d->friction * p.weight * answer.force / answer.root >
                    p.gain;
    } else if (first.moment > first.force) {
        answer = left;
        a->regime = DRIVEN_TO_STOP;
        a->stable = 1;
    } else {
        a->regime = HELD;
        return p;
    }
    a->root_count = (signed char)count;
    a->bend_angle = tension_l > tension_s ? -answer.angle : answer.angle;
    a->normal_force = p.total * answer.force;
    a->pressure = a->normal_force / d->area;
    a->residual = p.total * (answer.moment - answer.force);
    return p;
}

/* Forces, remainder and gradients. */
static inline void complete(const Design *d, const Pair *p, int mirrored, Answer *a)
{
    double side = mirrored ? -1.0 : 1.0, angle = fabs(a->bend_angle);
    double s = sin(angle), c = cos(angle);
    double sin_phi = d->sine * c + d->cosine * s, cos_phi = d->cosine * c - d->sine * s;
    double n = a->normal_force, lift = n - p->total;
    a->pressure_x = side * n * sin_phi;
    a->pressure_z = n * cos_phi;
    a->friction_x = side * d->friction * n * cos_phi;
    a->friction_z = d->friction * n * sin_phi;
    a->remainder_x = side * lift * s - a->friction_x;
    a->remainder_z = lift * c + a->friction_z - d->weight;
    a->branch_consistent = a->friction_z > d->weight;
    double b = p->total * (1.0 - d->friction * p->weight * sin_phi);
    double root = b - (1.0 - d->friction * d->friction) * n;
    double by_total = (p->total - n) / root;
    double by_angle = d->friction * d->weight * n * cos_phi / root;
    double slope = a->regime == DRIVEN_TO_STOP ? INFINITY : d->weight_gain * c - by_angle;
    double behind = (by_total + d->cable_gain) / slope;
    double ahead = (by_total - d->cable_gain) / slope;
    double by_behind = (by_total + by_angle * behind) / d->area;
    double by_ahead = (by_total + by_angle * ahead) / d->area;
    a->angle_by_l = mirrored ? -ahead : behind;
    a->angle_by_s = mirrored ? -behind : ahead;
    a->pressure_by_l = mirrored ? by_ahead : by_behind;
    a->pressure_by_s = mirrored ? by_behind : by_ahead;
}

/* Angle and pressure of each pair, as a node asks for them; returns a sum, so that it is done. */
double solve_each(const Design *d, size_t count, const double *tension_l, const double *tension_s)
{
    double sum = 0.0;
    for (size_t i = 0; i < count; i++) {
        Answer a;
        solve(d, tension_l[i], tension_s[i], &a);
        sum += a.bend_angle + a.pressure;
    }
    return sum;
}

/* All fields of each pair, into arrays: `numbers` has 14 rows of `count`, `codes` has five. */
void solve_many(const Design *d, size_t count, const double *tension_l, const double *tension_s,
                double *numbers, signed char *codes)
{
    for (size_t i = 0; i < count; i++) {
        Answer a;
        Pair p = solve(d, tension_l[i], tension_s[i], &a);
        if (isnan(a.bend_angle)) {
            for (int k = 0; k < 14; k++)
                numbers[k * count + i] = NAN;
        } else {
            complete(d, &p, tension_l[i] > tension_s[i], &a);
            const double row[14] = {
                a.bend_angle, a.pressure, a.normal_force, a.residual,
                a.pressure_x, a.pressure_z, a.friction_x, a.friction_z,
                a.remainder_x, a.remainder_z,
                a.angle_by_l, a.angle_by_s, a.pressure_by_l, a.pressure_by_s,
            };
            for (int k = 0; k < 14; k++)
                numbers[k * count + i] = row[k];
        }
        const signed char code[5] = {a.regime, a.root_count, a.iterations, a.stable,
                                     a.branch_consistent};
        for (int k = 0; k < 5; k++)
            codes[k * count + i] = code[k];
    }
}

size_t design_size(void) { return sizeof(Design); }
