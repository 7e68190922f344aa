/* Reading results.h5 back. Nothing is believed: a file may be foreign, cut short or damaged. */
#include <stdlib.h>
#include <string.h>

#include "harness/formulations/select.h"

#include "harness/records/kept.h"
#include "harness/records/results_case.h"
#include "harness/records/results_sweep.h"
#include "harness/records/table_reader.h"
#include "harness/study/checksum.h"

enum { NAME = 200 };

static status read_case(const char *path, hid_t cases, const char *name, results *out, fault *f)
{
    const hid_t here = H5Gopen2(cases, name, H5P_DEFAULT);
    if (here < 0)
        return results_case_damaged(path, "", name, f);
    const status outcome = results_case_read(path, here, name, out, f);
    H5Gclose(here);
    return outcome;
}

static status read_cases(const char *path, hid_t cases, results *out, fault *f)
{
    char name[NAME];
    H5G_info_t info = {0};
    if (H5Gget_info(cases, &info) < 0)
        return results_case_damaged(path, "", "cases", f);
    for (hsize_t i = 0; i < info.nlinks; i++) {
        if (H5Lget_name_by_idx(cases, ".", H5_INDEX_NAME, H5_ITER_INC, i, name, sizeof name,
                               H5P_DEFAULT) <= 0)
            return results_case_damaged(path, "", "cases", f);
        TRY(read_case(path, cases, name, out, f));
    }
    return STATUS_OK;
}

/* Those of verify, or, where it has left none, of bench. */
static hid_t open_cases(hid_t file)
{
    const char *of_bench = KEPT_GROUPS "/bench/cases";
    const int own = H5Lexists(file, "cases", H5P_DEFAULT) > 0 ||
                    H5Lexists(file, KEPT_GROUPS, H5P_DEFAULT) <= 0 ||
                    H5Lexists(file, KEPT_GROUPS "/bench", H5P_DEFAULT) <= 0;
    return H5Gopen2(file, own ? "cases" : of_bench, H5P_DEFAULT);
}

static status read_tables(const char *path, hid_t file, results *out, fault *f)
{
    const hid_t cases = open_cases(file);
    const status outcome =
        cases < 0 ? results_case_damaged(path, "", "cases", f) : read_cases(path, cases, out, f);
    out->whole = 1;
    if (cases >= 0)
        H5Gclose(cases);
    return outcome;
}

/* A text attribute as a copy, NULL where it is not there; 0: out of memory. */
static int read_text(hid_t file, const char *name, char **out)
{
    enum { MOST = 1 << 16 };
    char *room = malloc(MOST);
    *out = NULL;
    if (room != NULL && table_reader_attribute_text(file, name, room, MOST) && room[0] != '\0')
        *out = strdup(room);
    const int good = room != NULL && (*out != NULL || H5Aexists(file, name) <= 0);
    free(room);
    return good;
}

typedef struct declared_row {
    char formulation[FORMULATION_KEY];
    signed char is_new;
} declared_row;

/* Keys of formulations that do not gate; files that declare none have none. */
static status read_fresh(const char *path, hid_t file, results_part *out, fault *f)
{
    static const table_column columns[] = {
        {"formulation", FIELD_TEXT, offsetof(declared_row, formulation), FORMULATION_KEY},
        {"is_new", FIELD_FLAG, offsetof(declared_row, is_new), 0}};
    void *rows;
    if (H5Lexists(file, "declarations", H5P_DEFAULT) <= 0)
        return STATUS_OK;
    const int count =
        table_reader_rows(file, "declarations", 2, columns, sizeof(declared_row), &rows);
    const declared_row *row = rows;
    size_t size = 0;
    FILE *to = count >= 0 ? open_memstream(&out->fresh, &size) : NULL;
    for (int i = 0; to != NULL && i < count; i++)
        if (row[i].is_new)
            fprintf(to, "%s%s", ftell(to) > 0 ? "\n" : "", row[i].formulation);
    const int good = to != NULL && fclose(to) == 0;
    free(rows);
    return good ? STATUS_OK : results_case_damaged(path, "", "declarations", f);
}

static status read_part(const char *path, hid_t file, results_part *out, fault *f)
{
    if (!read_text(file, "selection", &out->select) ||
        !read_text(file, "selection_cases", &out->cases) ||
        !read_text(file, "selection_formulations", &out->formulations))
        return results_case_damaged(path, "", "selection", f);
    if (out->select != NULL && select_matches(out->select, "") < 0)
        return results_case_damaged(path, "", "selection", f);
    return read_fresh(path, file, out, f);
}

static status read_file(const char *path, hid_t file, results *out, fault *f)
{
    char schema[64];
    long version = 0;
    if (H5Aexists(file, "beamwork_sweep") > 0)
        return results_sweep_read(path, file, out, f);
    if (!table_reader_attribute_text(file, "schema", schema, sizeof schema) ||
        strcmp(schema, SCHEMA_NAME) != 0 ||
        !table_reader_attribute_count(file, "schema_version", &version))
        return fault_set(f, STATUS_FAULT,
                         "%.120s: not a file of results; write one with 'beamwork verify -o' or "
                         "'beamwork sweep -o'",
                         path);
    if (version < SCHEMA_OLDEST || version > SCHEMA_VERSION)
        return fault_set(f, STATUS_FAULT,
                         "%.120s: results of version %ld, this program reads %d to %d; run "
                         "'beamwork verify -o' again",
                         path, version, SCHEMA_OLDEST, SCHEMA_VERSION);
    TRY(read_part(path, file, &out->part, f));
    return read_tables(path, file, out, f);
}

status results_hdf5_read(const char *path, results *out, fault *f)
{
    TRY(checksum_check(path, f));
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file < 0)
        return fault_set(f, STATUS_FAULT,
                         "%.120s: cannot be read as HDF5; run 'beamwork verify -o' again", path);
    const status outcome = read_file(path, file, out, f);
    H5Fclose(file);
    return outcome;
}
