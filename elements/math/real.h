/* The type `real` contains a number for each of several elements, one in each lane. A source file
 * must define LANES before it includes this header. Each lane performs the operations in the order
 * of the source, so results are bit-for-bit identical for every number of lanes. An array of reals
 * in lanes is not an array of doubles; real_put and real_lane give access to it.
 *
 * The Makefile compiles some files a second time for processors with AVX2, with REAL_AVX2 defined.
 * REAL_NAMED gives the functions of both versions different names, and REAL_CHOSEN selects a
 * version. */
#ifndef BEAMWORK_REAL_H
#define BEAMWORK_REAL_H

#include <math.h>

#ifndef LANES
#define LANES 1
#endif

#ifdef REAL_AVX2
#define REAL_NAMED(name) name##_avx2
#else
#define REAL_NAMED(name) name##_plain
#endif
#ifdef __x86_64__
#define REAL_CHOSEN(name) (__builtin_cpu_supports("avx2") ? name##_avx2 : name##_plain)
#else
#define REAL_CHOSEN(name) name##_plain
#endif

#if LANES == 1

typedef double real;
/* Returns the same number in all lanes. */
static inline real real_of(double v)
{
    return v;
}
static inline double real_lane(const real *a, int lane)
{
    (void)lane;
    return *a;
}
static inline void real_put(real *a, int lane, double v)
{
    (void)lane;
    *a = v;
}
static inline real real_sqrt(real a)
{
    return sqrt(a);
}
/* Truth value of each lane, or 0 or 1 if there is only one lane. */
typedef int real_truth;
static inline real_truth real_true(void)
{
    return 1;
}
static inline int real_holds(real_truth t, int lane)
{
    (void)lane;
    return t;
}
static inline void real_deny(real_truth *t, int lane)
{
    (void)lane;
    *t = 0;
}
static inline real real_choose(real_truth t, real a, real b)
{
    return t ? a : b;
}

#else

typedef double real __attribute__((vector_size(LANES * sizeof(double))));
static inline real real_of(double v)
{
    return v - (real){0};
}
static inline double real_lane(const real *a, int lane)
{
    return (*a)[lane];
}
static inline void real_put(real *a, int lane, double v)
{
    (*a)[lane] = v;
}
static inline real real_sqrt(real a)
{
    for (int lane = 0; lane < LANES; lane++)
        a[lane] = sqrt(a[lane]);
    return a;
}
typedef long long real_truth __attribute__((vector_size(LANES * sizeof(long long))));
static inline real_truth real_true(void)
{
    return (real_truth){0} == 0;
}
static inline int real_holds(real_truth t, int lane)
{
    return t[lane] != 0;
}
static inline void real_deny(real_truth *t, int lane)
{
    (*t)[lane] = 0;
}
/* Returns a in the lanes where the condition is true, and b in the other lanes. */
static inline real real_choose(real_truth t, real a, real b)
{
    return (real)((t & (real_truth)a) | (~t & (real_truth)b));
}

#endif

static inline real real_abs(real a)
{
    return real_choose(a < 0, -a, a);
}

/* Returns 1 if the condition is true in any lane. */
static inline int real_any(real_truth t)
{
    int any = 0;
    for (int lane = 0; lane < LANES; lane++)
        any |= real_holds(t, lane);
    return any;
}

static inline void real_zero(int n, real a[])
{
    for (int i = 0; i < n; i++)
        a[i] = real_of(0);
}

static inline real real_atan2(real y, real x)
{
    real angle = y;
    for (int lane = 0; lane < LANES; lane++)
        real_put(&angle, lane, atan2(real_lane(&y, lane), real_lane(&x, lane)));
    return angle;
}
static inline real real_hypot(real a, real b)
{
    real length = a;
    for (int lane = 0; lane < LANES; lane++)
        real_put(&length, lane, hypot(real_lane(&a, lane), real_lane(&b, lane)));
    return length;
}
static inline void real_sincos(real a, real *sine, real *cosine)
{
    for (int lane = 0; lane < LANES; lane++) {
        real_put(sine, lane, sin(real_lane(&a, lane)));
        real_put(cosine, lane, cos(real_lane(&a, lane)));
    }
}

#endif
