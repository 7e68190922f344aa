#include "elements/sheet/second.h"

#include <string.h>

#include "elements/math/dense.h"

size_t sheet_second_data_size(const element_request *request)
{
    (void)request;
    return sizeof(sheet_base_data);
}

status sheet_second_prepare(const element_request *request, sheet_base_shear shear,
                            element_data *out, fault *f)
{
    return sheet_base_prepare(request, shear, (sheet_base_data *)(void *)out, f);
}

status sheet_second_stress(const element_data *data, const double e[], const double inner[],
                           stress_output *out)
{
    enum { N = SHEET_STRAINS };
    const sheet_base_data *d = (const sheet_base_data *)(const void *)data;
    double sigma[N];
    (void)inner;
    dense_mul_vec(N, N, d->S, e, sigma);
    if (out->energy != NULL) {
        *out->energy = 0;
        for (int i = 0; i < N; i++)
            *out->energy += sigma[i] * e[i] / 2;
    }
    if (out->sigma != NULL)
        memcpy(out->sigma, sigma, sizeof sigma);
    if (out->C != NULL)
        memcpy(out->C, d->S, sizeof d->S);
    if (out->residual != NULL)
        *out->residual = 0;
    sheet_wagner_add(&d->wagner, e, out->energy, out->sigma, out->C);
    return STATUS_OK;
}
