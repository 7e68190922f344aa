#include "harness/records/matrix_market.h"

void matrix_market_write(FILE *to, const triplets *t, const char *comment)
{
    static const char *const kind[] = {"general", "symmetric", "skew-symmetric"};
    fprintf(to, "%%%%MatrixMarket matrix coordinate real %s\n", kind[t->kind]);
    if (comment != NULL)
        fprintf(to, "%% %s\n", comment);
    fprintf(to, "%d %d %d\n", t->rows, t->columns, t->entries);
    for (int i = 0; i < t->entries; i++)
        fprintf(to, "%d %d %.17g\n", t->row[i] + 1, t->column[i] + 1, t->value[i]);
}
