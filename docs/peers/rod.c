/* Rates of plain C on the rods of `cargo xtask bench`, one thread: what a compiler makes of simple loops.
 *
 *     cc -O3 -march=x86-64-v3 -fno-math-errno -fno-trapping-math docs/peers/rod.c -lm -o target/peers/rod
 *     target/peers/rod C-AVX2
 *
 * The name of the peer is printed with each rate; an argument after it is the time per case (s).
 * For AVX-512: -march=x86-64-v4 -mprefer-vector-width=512.
 *
 * Rods as Gazzola, Dudte, McCormick and Mahadevan 2018 discretise them (as PyElastica does): matrices
 * of directors, a stretch e of each element by which sections shrink and inertia changes. Clamped, 160 nm,
 * 2 pN across the tip, position Verlet; the half drifts between steps are one.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { BATCH = 200000 }; /* Element-steps between two looks at the clock. */

/* Components lie `stride` apart: that of axis i of element k at [i * stride + k]. */
typedef struct {
    int elements, stride;
    double rest, mass, force;         /* nm, pN ns^2/nm of an element, pN across the tip */
    double shear, stretch;            /* pN */
    double bend, twist;               /* pN nm^2 */
    double inertia[3];                /* pN nm ns^2 of an element */
    double *x, *v;                    /* nodes: nm, nm/ns */
    double *q;                        /* elements: directors as rows, nine components */
    double *w;                        /* rad/ns, body axes */
    double *length;                   /* nm */
    double *force_of, *torque_of;     /* of elements: pN in the lab, pN nm in the body */
    double *couple, *turned;          /* between elements k - 1 and k: even and odd part, pN nm */
} Rod;

/* Free motion for a time h (ns); angles of a drift are below 1 rad. */
static void drift(Rod *r, double h)
{
    const int n = r->elements, s = r->stride;
    double *restrict x = r->x, *restrict q = r->q;
    const double *restrict v = r->v, *restrict w = r->w;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k <= n; k++)
            x[i * s + k] += h * v[i * s + k];
#pragma GCC ivdep
    for (int k = 0; k < n; k++) {
        const double a = h * w[k], b = h * w[s + k], c = h * w[2 * s + k];
        const double u = a * a + b * b + c * c;
        /* sin(t)/t and (1 - cos(t))/t^2 with t^2 = u */
        const double f = 1 - 1. / 6 * u * (1 - 1. / 20 * u * (1 - 1. / 42 * u * (1 - 1. / 72 * u)));
        const double g = 0.5 * (1 - 1. / 12 * u * (1 - 1. / 30 * u * (1 - 1. / 56 * u * (1 - 1. / 90 * u))));
        const double ab = g * a * b, ac = g * a * c, bc = g * b * c;
#pragma GCC unroll 3
        for (int j = 0; j < 3; j++) {
            const double d1 = q[j * s + k], d2 = q[(3 + j) * s + k], d3 = q[(6 + j) * s + k];
            q[j * s + k] = (1 - g * (b * b + c * c)) * d1 + (ab + f * c) * d2 + (ac - f * b) * d3;
            q[(3 + j) * s + k] = (ab - f * c) * d1 + (1 - g * (a * a + c * c)) * d2 + (bc + f * a) * d3;
            q[(6 + j) * s + k] = (ac + f * b) * d1 + (bc - f * a) * d2 + (1 - g * (a * a + b * b)) * d3;
        }
    }
}

/* Shear, stretch, and the motion of the frame itself. */
static void elements(Rod *r)
{
    const int n = r->elements, s = r->stride;
    const double *restrict x = r->x, *restrict v = r->v, *restrict q = r->q, *restrict w = r->w;
    double *restrict force = r->force_of, *restrict torque = r->torque_of, *restrict length = r->length;
    const double rest = r->rest, inverse = 1 / rest, ga = r->shear, ea = r->stretch;
    const double j1 = r->inertia[0], j2 = r->inertia[1], j3 = r->inertia[2];
#pragma GCC ivdep
    for (int k = 0; k < n; k++) {
        const double l0 = x[k + 1] - x[k], l1 = x[s + k + 1] - x[s + k], l2 = x[2 * s + k + 1] - x[2 * s + k];
        const double u0 = v[k + 1] - v[k], u1 = v[s + k + 1] - v[s + k], u2 = v[2 * s + k + 1] - v[2 * s + k];
        const double squared = l0 * l0 + l1 * l1 + l2 * l2, unit = 1 / sqrt(squared);
        const double shrunk = rest * unit; /* 1/e */
        const double growth = (l0 * u0 + l1 * u1 + l2 * u2) * unit * unit; /* (de/dt)/e */
        const double y0 = (q[k] * l0 + q[s + k] * l1 + q[2 * s + k] * l2) * inverse;
        const double y1 = (q[3 * s + k] * l0 + q[4 * s + k] * l1 + q[5 * s + k] * l2) * inverse;
        const double y2 = (q[6 * s + k] * l0 + q[7 * s + k] * l1 + q[8 * s + k] * l2) * inverse;
        const double n0 = ga * y0 * shrunk, n1 = ga * y1 * shrunk, n2 = ea * (y2 - 1) * shrunk;
        const double w0 = w[k], w1 = w[s + k], w2 = w[2 * s + k];
        const double m0 = j1 * w0 * shrunk, m1 = j2 * w1 * shrunk, m2 = j3 * w2 * shrunk;
        length[k] = squared * unit;
        force[k] = q[k] * n0 + q[3 * s + k] * n1 + q[6 * s + k] * n2;
        force[s + k] = q[s + k] * n0 + q[4 * s + k] * n1 + q[7 * s + k] * n2;
        force[2 * s + k] = q[2 * s + k] * n0 + q[5 * s + k] * n1 + q[8 * s + k] * n2;
        torque[k] = (y1 * n2 - y2 * n1) * rest + m1 * w2 - m2 * w1 + m0 * growth;
        torque[s + k] = (y2 * n0 - y0 * n2) * rest + m2 * w0 - m0 * w2 + m1 * growth;
        torque[2 * s + k] = (y0 * n1 - y1 * n0) * rest + m0 * w1 - m1 * w0 + m2 * growth;
    }
}

/* Dot product of director a of element k + 1 with director b of element k. */
#define DOT(a, b)                                                                                  \
    (q[3 * (a) * s + k + 1] * q[3 * (b) * s + k] + q[(3 * (a) + 1) * s + k + 1] * q[(3 * (b) + 1) * s + k] \
     + q[(3 * (a) + 2) * s + k + 1] * q[(3 * (b) + 2) * s + k])

/* Bending and twist between neighbours; angles below 1 rad. */
static void joints(Rod *r)
{
    const int n = r->elements, s = r->stride;
    const double *restrict q = r->q, *restrict length = r->length;
    double *restrict couple = r->couple, *restrict turned = r->turned;
    const double rest = r->rest, inverse = 1 / rest, bend = r->bend, twist = r->twist;
#pragma GCC ivdep
    for (int k = 0; k < n - 1; k++) {
        /* u = sin^2(t/2); t/(2 sin t) as its series in u */
        const double u = 0.25 * (3 - (DOT(0, 0) + DOT(1, 1) + DOT(2, 2)));
        const double p5 = 1 + 10. / 11 * u * (1 + 12. / 13 * u * (1 + 14. / 15 * u));
        const double p = 1 + 2. / 3 * u * (1 + 4. / 5 * u * (1 + 6. / 7 * u * (1 + 8. / 9 * u * p5)));
        const double scale = 0.5 * p * inverse;
        const double k0 = scale * (DOT(1, 2) - DOT(2, 1));
        const double k1 = scale * (DOT(2, 0) - DOT(0, 2));
        const double k2 = scale * (DOT(0, 1) - DOT(1, 0));
        const double e = 0.5 * inverse * (length[k] + length[k + 1]), cubed = 1 / (e * e * e);
        const double m0 = bend * k0 * cubed, m1 = bend * k1 * cubed, m2 = twist * k2 * cubed;
        couple[k + 1] = m0, couple[s + k + 1] = m1, couple[2 * s + k + 1] = m2;
        turned[k + 1] = 0.5 * rest * (k1 * m2 - k2 * m1);
        turned[s + k + 1] = 0.5 * rest * (k2 * m0 - k0 * m2);
        turned[2 * s + k + 1] = 0.5 * rest * (k0 * m1 - k1 * m0);
    }
}

/* Loads at these places for a time h (ns); node and element 0 are held. */
static void kick(Rod *r, double h)
{
    const int n = r->elements, s = r->stride;
    elements(r);
    joints(r);
    for (int i = 0; i < 3; i++) {
        const double *restrict force = r->force_of + i * s, *restrict torque = r->torque_of + i * s;
        const double *restrict couple = r->couple + i * s, *restrict turned = r->turned + i * s;
        const double *restrict length = r->length;
        double *restrict v = r->v + i * s, *restrict w = r->w + i * s;
        const double per_mass = h / r->mass, per_inertia = h / (r->inertia[i] * r->rest);
        for (int k = 1; k < n; k++)
            v[k] += per_mass * (force[k] - force[k - 1]);
        /* Half an element's mass is at the tip. */
        v[n] += 2 * per_mass * ((i == 0 ? -r->force : 0) - force[n - 1]);
        for (int k = 1; k < n; k++)
            w[k] += per_inertia * length[k] * (torque[k] + couple[k + 1] - couple[k] + turned[k + 1] + turned[k]);
    }
}

/* A straight rod along z. */
static Rod straight(int n)
{
    const double long_nm = 160, area = 38.5, young = 2000, shear = young / (2 * (1 + 0.4));
    const double density = 0.0697 / 2.7385 / area, second = area * area / (4 * acos(-1));
    const int s = (n + 1 + 15) / 8 * 8;
    Rod r = { .elements = n, .stride = s, .rest = long_nm / n, .force = 2 };
    r.mass = density * area * r.rest;
    r.shear = 4. / 3 * shear * area, r.stretch = young * area;
    r.bend = young * second, r.twist = 2 * shear * second;
    for (int i = 0; i < 3; i++)
        r.inertia[i] = density * second * r.rest * (i < 2 ? 1 : 2);
    const size_t bytes = sizeof(double) * 31 * s;
    double *all = aligned_alloc(64, (bytes + 63) / 64 * 64);
    memset(all, 0, bytes);
    double **part[] = { &r.x, &r.v, &r.q, &r.w, &r.force_of, &r.torque_of, &r.couple, &r.turned, &r.length };
    const int rows[] = { 3, 3, 9, 3, 3, 3, 3, 3, 1 };
    for (int i = 0; i < 9; all += rows[i] * s, i++)
        *part[i] = all;
    for (int k = 0; k <= n; k++)
        r.x[2 * s + k] = k * r.rest;
    for (int k = 0; k < n; k++)
        r.q[k] = r.q[4 * s + k] = r.q[8 * s + k] = 1;
    return r;
}

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec + 1e-9 * now.tv_nsec;
}

/* Steps of one rod after the other, as batches of ours. */
static void advance(Rod *r, double h, int steps)
{
    drift(r, 0.5 * h);
    for (int i = 1; i < steps; i++) {
        kick(r, h);
        drift(r, h);
    }
    kick(r, h);
    drift(r, 0.5 * h);
}

/* Element-steps per second of the fastest batch. */
static double best_rate(int n, int count, double budget)
{
    Rod *rods = malloc(count * sizeof *rods);
    for (int i = 0; i < count; i++)
        rods[i] = straight(n);
    const double h = 0.02 * rods->rest / sqrt(rods->stretch / (rods->mass / rods->rest));
    const int steps = BATCH / (n * count) > 150 ? BATCH / (n * count) : 150;
    double best = 1e300;
    for (double end = seconds() + budget; seconds() < end;) {
        const double start = seconds();
        for (int i = 0; i < count; i++)
            advance(rods + i, h, steps);
        const double time = seconds() - start;
        best = time < best ? time : best;
    }
    const int s = rods->stride;
    if (!isfinite(rods->x[n] + rods->x[s + n] + rods->x[2 * s + n]))
        exit(1);
    return (double)n * count * steps / best;
}

int main(int argc, char **argv)
{
    const int cases[][2] = { { 16, 1 }, { 64, 1 }, { 256, 1 }, { 1024, 1 }, { 64, 64 } };
    const char *peer = argc > 1 ? argv[1] : "C";
    const double budget = argc > 2 ? atof(argv[2]) : 3;
    for (int i = 0; i < 5; i++) {
        const int *c = cases[i];
        char name[32];
        snprintf(name, sizeof name, c[1] > 1 ? "rod-pv-%dx%d" : "rod-pv-%d", c[0], c[1]);
        printf("%-20s %-12s %.2f\n", name, peer, 1e-6 * best_rate(c[0], c[1], budget));
        fflush(stdout);
    }
}
