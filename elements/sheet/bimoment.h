/* Bimoment of the third-order element (N section 3.3): solution of  lambda^2 b - b'' = L f  in x = s/L, stable for every lambda. */
#ifndef BEAMWORK_SHEET_BIMOMENT_H
#define BEAMWORK_SHEET_BIMOMENT_H

typedef struct bimoment_values {
    double c1, c2, dc1, dc2; /* cosh(lambda x)/sinh(lambda), cosh(lambda (1-x))/sinh(lambda), and d/dx */
    double torque, dtorque;  /* sinh(lambda/2 - lambda x)/(lambda cosh(lambda/2)), and d/dx */
} bimoment_values;

void bimoment_functions(double lambda, double x, bimoment_values *out);

/* b and db/dx of lambda^2 b - b'' = f2 x^2 + f1 x + f0, b'(0) = -m0, b'(1) = -m1 (times L: the moment's share).
 * The right-hand side and the ends are in balance: f2/3 + f1/2 + f0 = m1 - m0, so that b stays finite for lambda -> 0. */
typedef struct bimoment_load {
    double f2, f1, f0, m0, m1;
} bimoment_load;
void bimoment_moment(double lambda, const bimoment_load *load, double x, double *b, double *db);

#endif
