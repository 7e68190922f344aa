/* What the result file consists of, from the tables it is written by. */
#include <stdio.h>
#include <string.h>

#include "harness/cli/cli.h"
#include "harness/extremes/extreme_record.h"
#include "harness/record/json.h"
#include "harness/record/json_record.h"

static const char about[] =
    "HDF5; the last line of the file, behind it, holds its length and checksum. Attributes of the "
    "root: schema, schema_version,\n"
    "program_version, commit, compiler, flags, libraries, processor, clock (UTC), threads, "
    "unfinished_cells (of an interrupted "
    "run). Below /cases/CASE (attributes: "
    "summary,\n"
    "source) stands a table for each kind of record; attributes of a table: units and summaries of "
    "its columns, in their order.\n"
    "The same names stand in JSON and CSV; fields marked * are said there only, in HDF5 by what is "
    "around them. Numbers that\n"
    "do not exist are NaN (JSON: null). [unit]: that of the column `unit`.\n"
    "curve_x, curve_value: the points of all curves of a case, one after the other.\n"
    "shapes/POINT (verify --shapes, solve --shapes; attributes formulation, elements): members "
    "(nodes p, q, section), "
    "first_point,\n"
    "bodies of the nodes (body or -1, held components as bits), released (components at both ends "
    "of members, as bits), sections/I (corners of walls, y "
    "and z in m), and of every state\n"
    "kind, analysis, value, scale and [states x points] position, orientation (quaternion), force, "
    "moment, bimoment, nodes.\n"
    "points has a column for each parameter of the case besides. Keyed by point, formulation and "
    "elements.\n";

/* Ends with NULL. */
static const record_type *const of_extremes[] = {&record_extreme, &record_extreme_count,
                                                 &record_outcome, NULL};

static void show_field(const schema_field *which)
{
    printf("  %-20s %-7s %-7s %s", which->name,
           which->key == KEY_AROUND ? "text *" : schema_kind_name(which->kind),
           strcmp(which->unit, OWN_UNIT) == 0 ? "[unit]" : which->unit, which->summary);
    for (int i = 0; i < which->words; i++)
        printf("%s%s", i > 0 ? ", " : " (", which->word(i));
    printf(which->words > 0 ? ")\n" : "\n");
}

static void show(const char *place, const record_type *type)
{
    const schema_field *list[SCHEMA_MOST_FIELDS];
    const int count = schema_fields(type, KEY_AROUND, list);
    printf("\n%s%s: %s\n", place, type->table, type->summary);
    for (int i = 0; i < count; i++)
        show_field(list[i]);
}

static status write_json(fault *f)
{
    json_t *records = json_array();
    for (int i = 0; record_types[i] != NULL; i++)
        json_array_append_new(records, json_record_type(record_types[i]));
    json_array_append_new(records, json_record_type(&record_declaration));
    json_array_append_new(records, json_record_type(&record_truth));
    for (int i = 0; of_extremes[i] != NULL; i++)
        json_array_append_new(records, json_record_type(of_extremes[i]));
    return json_finish(json_pack("{s:s,s:i,s:o}", "schema", SCHEMA_NAME, "schema_version",
                                 SCHEMA_VERSION, "records", records),
                       stdout, f);
}

int cli_schema(int count, char **arguments)
{
    command_request r;
    fault f = {""};
    command_parse(
        "schema", "",
        "Describes the result file of verify, bench and solve (-o FILE), and the records of "
        "JSON and CSV."
        "\vbeamwork schema --format json",
        "F", count, arguments, &r);
    if (r.case_name != NULL)
        return message_fail(STATUS_REFUSED, "schema takes no case; it describes the files of all");
    if (r.format[0] == 'j')
        return message_exit(write_json(&f), &f);
    if (r.format[0] == 'c')
        return message_fail(STATUS_REFUSED, "schema is written as text or json");
    printf("%s, version %d\n%s", SCHEMA_NAME, SCHEMA_VERSION, about);
    show("/", &record_declaration);
    for (int i = 0; record_types[i] != NULL; i++)
        show("/cases/CASE/", record_types[i]);
    show("solve --format json, ", &record_truth);
    for (int i = 0; of_extremes[i] != NULL; i++)
        show("stress --json, ", of_extremes[i]);
    return EXIT_AS_EXPECTED; /* main flushes */
}
