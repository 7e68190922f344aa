#include "harness/study/imported.h"

#include <stdlib.h>
#include <string.h>

int imported_same_model(const imported *i)
{
    return strcmp(i->model, "beam") == 0;
}

void imported_free(imported *i)
{
    if (i == NULL)
        return;
    free(i->row);
    free(i);
}
