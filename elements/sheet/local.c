/* Seen from p: d = Rp^T (rq - rp) and Rp^T Rq = exp(eta~) R0.  With rho = hypot(dx, dy):
 *   yp = atan2(dz, rho), zp = -atan2(dy, dx), and with b = (-dy, dx, 0), the y axis of the frame pu times rho,
 *   px = atan2(-b.Zq, b.Yq), zq = atan2(b.Xq/rho, ...) , yq = atan2(-(c.Xq)/rho, d.Xq), c = (-dz dx, -dz dy, rho^2).
 * In the exponential chart of both nodes d = Rp^T exp(-tp~)(rq - rp) and eta = Rp^T (tq - tp - tp x tq/2). */
#include "elements/sheet/local.h"

#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/jet.h"

enum { VARIABLES = JET_VARIABLES };

static jet variable(double value, int index)
{
    jet j = {.value = value};
    j.gradient[index] = 1;
    return j;
}

static int pair(int i, int j)
{
    const int low = i < j ? i : j, high = i < j ? j : i;
    return low * VARIABLES - low * (low - 1) / 2 + high - low;
}

/* Column v of Rp^T Rq as it turns: v + eta x v + (eta (eta . v) - v |eta|^2)/2. */
static void turning_column(const double v[3], jet out[3])
{
    const double skew[3][3] = {{0, v[2], -v[1]}, {-v[2], 0, v[0]}, {v[1], -v[0], 0}}; /* d(eta x v)_i/d eta_k */
    for (int i = 0; i < 3; i++) {
        memset(&out[i], 0, sizeof out[i]);
        out[i].value = v[i];
        for (int k = 0; k < 3; k++)
            out[i].gradient[3 + k] = skew[i][k];
        for (int k = 0; k < 3; k++)
            for (int m = k; m < 3; m++)
                out[i].hessian[pair(3 + k, 3 + m)] = ((i == k ? v[m] : 0) + (i == m ? v[k] : 0)) / 2 - (k == m ? v[i] : 0);
    }
}

static jet product_sum(const jet *a, const jet *b, double sign, const jet *c, const jet *e) /* a b + sign c e */
{
    const jet first = jet_mul(a, b), second = jet_mul(c, e);
    return jet_add(&first, 1, &second, sign);
}

/* The five angles as jets of (d, eta). */
static void angles(const double d_value[3], const double R[9], jet out[6])
{
    jet d[3], column[3][3];
    for (int i = 0; i < 3; i++)
        d[i] = variable(d_value[i], i);
    for (int k = 0; k < 3; k++) {
        const double v[3] = {R[k], R[3 + k], R[6 + k]};
        turning_column(v, column[k]);
    }
    const jet *X = column[0], *Y = column[1], *Z = column[2];
    const jet rho2 = product_sum(&d[0], &d[0], 1, &d[1], &d[1]), rho = jet_sqrt(&rho2);
    out[LOCAL_YP] = jet_atan2(&d[2], &rho);
    const jet azimuth = jet_atan2(&d[1], &d[0]);
    out[LOCAL_ZP] = jet_add(&azimuth, -1, &azimuth, 0);
    const jet bZ = product_sum(&d[0], &Z[1], -1, &d[1], &Z[0]), bY = product_sum(&d[0], &Y[1], -1, &d[1], &Y[0]),
              bX = product_sum(&d[0], &X[1], -1, &d[1], &X[0]);
    const jet minus_bZ = jet_add(&bZ, -1, &bZ, 0);
    out[LOCAL_PX] = jet_atan2(&minus_bZ, &bY);
    /* along = rho (dx Xx + dy Xy)/rho^2 ...: components of Xq in the frame pu times rho and l. */
    const jet flat = product_sum(&d[0], &X[0], 1, &d[1], &X[1]);
    const jet n = product_sum(&rho2, &X[2], -1, &d[2], &flat);              /* c . Xq = l rho (B_z . Xq) */
    const jet dX = product_sum(&d[2], &X[2], 1, &flat, &(jet){.value = 1}); /* d . Xq = l (B_x . Xq) */
    const jet along = jet_mul(&rho, &dX), minus_n = jet_add(&n, -1, &n, 0);
    out[LOCAL_YQ] = jet_atan2(&minus_n, &along);
    /* sin zq = bX/rho; cos zq = hypot(the other two)/(l rho) >= 0 */
    const jet bX2 = jet_mul(&bX, &bX), rest = jet_add(&rho2, 1, &bX2, -1), across = jet_sqrt(&rest);
    out[LOCAL_ZQ] = jet_atan2(&bX, &across);
}

/* Gradient in the element's coordinates from that in (d, eta). */
static void chain(const double Rp[9], const double d[3], const double g[6], double row[14])
{
    double gd[3], ge[3], moment[3];
    const double *at_d = g, *at_eta = g + 3;
    double cross[3];
    mat3_mul_vec(Rp, at_d, gd);
    mat3_mul_vec(Rp, at_eta, ge);
    vec3_cross(d, at_d, cross); /* d(d)/dtp = Rp^T (rq - rp)~: gradient (rq - rp) x ... */
    mat3_mul_vec(Rp, cross, moment);
    memset(row, 0, 14 * sizeof *row);
    for (int i = 0; i < 3; i++) {
        row[i] = -gd[i];
        row[7 + i] = gd[i];
        row[3 + i] = -moment[i] - ge[i];
        row[10 + i] = ge[i];
    }
}

void local_evaluate(double length, const node_state x[2], int derivatives, local_frame *l)
{
    double between[3], R[9], sum = 0;
    jet angle[6];
    for (int i = 0; i < 3; i++) {
        const double moved = x[1].u[i] - x[0].u[i];
        between[i] = x[1].r[i] - x[0].r[i];
        sum += (2 * between[i] - moved) * moved;
    }
    memcpy(l->Rp, x[0].R, sizeof l->Rp);
    mat3_transpose_mul_vec(x[0].R, between, l->d);
    mat3_transpose_mul(x[0].R, x[1].R, R);
    angles(l->d, R, angle);
    const double now = sqrt(vec3_dot(between, between));
    l->value[LOCAL_U] = sum / (now + length);
    l->value[LOCAL_WP] = x[0].a;
    l->value[LOCAL_WQ] = x[1].a;
    for (int a = LOCAL_PX; a <= LOCAL_ZQ; a++)
        l->value[a] = angle[a].value;
    if (derivatives == 0)
        return;
    memset(l->gradient, 0, sizeof l->gradient);
    memset(l->inner_gradient, 0, sizeof l->inner_gradient);
    for (int i = 0; i < 3; i++)
        l->inner_gradient[LOCAL_U][i] = l->d[i] / now;
    for (int i = 0, k = 0; i < 6; i++)
        for (int j = i; j < 6; j++, k++)
            l->inner_hessian[LOCAL_U][k] = j < 3 ? ((i == j) - l->d[i] * l->d[j] / (now * now)) / now : 0;
    for (int a = LOCAL_PX; a <= LOCAL_ZQ; a++) {
        memcpy(l->inner_gradient[a], angle[a].gradient, sizeof angle[a].gradient);
        memcpy(l->inner_hessian[a], angle[a].hessian, sizeof angle[a].hessian);
    }
    for (int a = 0; a < 6; a++)
        chain(l->Rp, l->d, l->inner_gradient[a], l->gradient[a]);
    l->gradient[LOCAL_WP][6] = l->gradient[LOCAL_WQ][13] = 1;
}

/* Second derivatives of d and eta themselves, for the weights g = sum w_a d x_a/d(d, eta). */
static void add_chart_terms(const local_frame *l, const double g[6], double H[14 * 14])
{
    double F[3], m[3], r[3];
    mat3_mul_vec(l->Rp, g, F);
    mat3_mul_vec(l->Rp, g + 3, m);
    mat3_mul_vec(l->Rp, l->d, r);
    const double dot = vec3_dot(F, r), skew_F[9] = {0, -F[2], F[1], F[2], 0, -F[0], -F[1], F[0], 0};
    const double skew_m[9] = {0, -m[2], m[1], m[2], 0, -m[0], -m[1], m[0], 0};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            /* F . [tp x (tp x r)]/2 and -F . (tp x (rq - rp)) */
            H[(3 + i) * 14 + 3 + j] += (F[i] * r[j] + r[i] * F[j]) / 2 - (i == j ? dot : 0);
            const double turn = skew_F[3 * i + j];
            H[(3 + i) * 14 + 7 + j] += turn;
            H[(7 + j) * 14 + 3 + i] += turn;
            H[(3 + i) * 14 + j] -= turn;
            H[j * 14 + 3 + i] -= turn;
            /* -m . (tp x tq)/2 */
            const double half = skew_m[3 * i + j] / 2;
            H[(3 + i) * 14 + 10 + j] += half;
            H[(10 + j) * 14 + 3 + i] += half;
        }
}

/* d(d, eta)/dx applied to column j: the six rates. */
static void inner_rates(const local_frame *l, double T[6][12])
{
    memset(T, 0, 6 * sizeof T[0]);
    double r[3];
    mat3_mul_vec(l->Rp, l->d, r);
    const double skew_r[9] = {0, -r[2], r[1], r[2], 0, -r[0], -r[1], r[0], 0};
    double turned[9];
    mat3_transpose_mul(l->Rp, skew_r, turned);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            T[i][j] = -l->Rp[3 * j + i];
            T[i][6 + j] = l->Rp[3 * j + i];
            T[i][3 + j] = turned[3 * i + j];
            T[3 + i][3 + j] = -l->Rp[3 * j + i];
            T[3 + i][9 + j] = l->Rp[3 * j + i];
        }
}

void local_add_hessian(const local_frame *l, const double w[LOCALS], double H[14 * 14])
{
    static const int place[12] = {0, 1, 2, 3, 4, 5, 7, 8, 9, 10, 11, 12};
    double g[6] = {0}, h[6][6], T[6][12], hT[6][12] = {{0}};
    for (int a = 0; a < 6; a++)
        for (int i = 0; i < 6; i++)
            g[i] += w[a] * l->inner_gradient[a][i];
    for (int i = 0, k = 0; i < 6; i++)
        for (int j = i; j < 6; j++, k++) {
            double sum = 0;
            for (int a = 0; a < 6; a++)
                sum += w[a] * l->inner_hessian[a][k];
            h[i][j] = h[j][i] = sum;
        }
    inner_rates(l, T);
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++)
            for (int c = 0; c < 12; c++)
                hT[i][c] += h[i][j] * T[j][c];
    for (int a = 0; a < 12; a++)
        for (int c = 0; c < 12; c++) {
            double sum = 0;
            for (int i = 0; i < 6; i++)
                sum += T[i][a] * hT[i][c];
            H[place[a] * 14 + place[c]] += sum;
        }
    add_chart_terms(l, g, H);
}
