/* Rigid motions about an origin, of a node at a place. */
#include <gsl/gsl_test.h>
#include <math.h>

#include "harness/model/model.h"

int main(void)
{
    enum { N = 6 };
    const double at[3] = {0.3, -0.7, 1.1}, length = 2;
    /* u = t + w x at / length, and w / length, columns t and w */
    const double expected[N][N] = {{1, 0, 0, 0, at[2] / length, -at[1] / length},
                                   {0, 1, 0, -at[2] / length, 0, at[0] / length},
                                   {0, 0, 1, at[1] / length, -at[0] / length, 0},
                                   {0, 0, 0, 1 / length, 0, 0},
                                   {0, 0, 0, 0, 1 / length, 0},
                                   {0, 0, 0, 0, 0, 1 / length}};
    double G[N * N + 1];
    for (int i = 0; i <= N * N; i++)
        G[i] = 17;
    supports_rigid(at, length, G);
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++)
            gsl_test_abs(G[N * i + j], expected[i][j], 1e-15, "entry %d, %d", i, j);
    gsl_test(G[N * N] != 17, "what stands behind is left alone");
    return gsl_test_summary();
}
