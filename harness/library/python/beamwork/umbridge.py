"""python -m beamwork.umbridge SCENE serves a scene as a model of UM-Bridge (https://um-bridge.org, protocol 1.0).

Programs for uncertainty quantification and optimisation, in any language, can then call the model:

    model = umbridge.HTTPModel("http://localhost:4242", "forward")
    model([[0.5e-3, 210e9]], {"elements": 4})       # [[drive_force]]

The model `forward` has one input vector, the parameters of the scene, and one output vector, its quantities, all in SI
units. The member `config` of a request may contain "formulation", "elements" and other parameters. Gradients are not
supported."""
from __future__ import annotations

import argparse
import json
import math
import os
import sys
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

from .errors import Error, Refused
from .scene import Scene

MODEL = "forward"
SUPPORT = {"Evaluate": True, "Gradient": False, "ApplyJacobian": False, "ApplyHessian": False}


class Invalid(Exception):
    """Raised for a request that cannot be answered. kind: error type of UM-Bridge; status: HTTP status."""

    def __init__(self, kind: str, words: str, status: int = 400) -> None:
        super().__init__(words)
        self.kind, self.status = kind, status


class Model:
    """A scene with selected parameters as inputs and selected quantities as outputs (none selected: all)."""

    def __init__(self, scene: Scene, inputs: list[str] | None = None, outputs: list[str] | None = None,
                 formulation: str | None = None, elements: int | None = None) -> None:
        about = scene.about
        numbers = [p["name"] for p in about["parameters"] if not p.get("choices")]
        values = [q["name"] for q in about["quantities"] if not q["is_curve"]]
        self.scene, self.formulation, self.elements = scene, formulation, elements
        self.inputs = chosen(inputs, numbers, "parameter")
        self.outputs = chosen(outputs, values, "quantity")

    def evaluate(self, values: Any, config: dict[str, Any]) -> list[float]:
        if not (isinstance(values, list) and len(values) == 1 and isinstance(values[0], list)
                and len(values[0]) == len(self.inputs)):
            raise Invalid("InvalidInput", f"input: one vector of {len(self.inputs)} numbers is expected: "
                          f"{', '.join(self.inputs)}")
        if not all(isinstance(v, (int, float)) and not isinstance(v, bool) for v in values[0]):
            raise Invalid("InvalidInput", "input: a number is expected")
        others = {k: v for k, v in config.items() if k not in ("formulation", "elements")}
        scene = self.scene.copy()
        try:
            scene.set(**others, **dict(zip(self.inputs, values[0])))
            result = scene.solve(config.get("formulation", self.formulation), config.get("elements", self.elements))
            found = [float(result[name]) for name in self.outputs]
        except TypeError as why:
            raise Invalid("InvalidInput", str(why)) from why
        except Refused as why:
            raise Invalid("InvalidInput", str(why)) from why
        except Error as why:
            raise Invalid("InvalidOutput", str(why), 500) from why
        for name, value in zip(self.outputs, found):
            if not math.isfinite(value):
                raise Invalid("InvalidOutput", f"{name} has no value", 500)
        return found

    def answer(self, path: str, request: dict[str, Any]) -> dict[str, Any]:
        if path == "/Info":
            return {"protocolVersion": 1.0, "models": [MODEL]}
        if request.get("name") != MODEL:
            raise Invalid("ModelNotFound", f"model {request.get('name')!r} does not exist; use '{MODEL}'")
        if path == "/ModelInfo":
            return {"support": SUPPORT}
        if path == "/InputSizes":
            return {"inputSizes": [len(self.inputs)]}
        if path == "/OutputSizes":
            return {"outputSizes": [len(self.outputs)]}
        if path == "/Evaluate":
            return {"output": [self.evaluate(request.get("input"), request.get("config") or {})]}
        raise Invalid("UnsupportedFeature", f"{path.strip('/')} is not supported; use Evaluate")


def chosen(names: list[str] | None, known: list[str], kind: str) -> list[str]:
    for name in names or ():
        if name not in known:
            raise ValueError(f"{kind} '{name}' does not exist; the scene has: {', '.join(known) or 'none'}")
    return list(names) if names else known


def server(model: Model, port: int = 4242, host: str = "localhost") -> ThreadingHTTPServer:
    """Returns a server; its serve_forever() answers requests. port 0: any free port (server_port)."""

    class Handler(BaseHTTPRequestHandler):

        def respond(self, status: int, content: dict[str, Any]) -> None:
            text = json.dumps(content).encode()
            self.send_response(status)
            self.send_header("Content-Type", "application/json")
            self.send_header("Content-Length", str(len(text)))
            self.end_headers()
            self.wfile.write(text)

        def do_GET(self) -> None:
            self.do_POST()

        def do_POST(self) -> None:
            try:
                text = self.rfile.read(int(self.headers.get("Content-Length") or 0))
                request = json.loads(text or b"{}")
                if not isinstance(request, dict) or not isinstance(request.get("config") or {}, dict):
                    raise ValueError("an object is expected")
            except ValueError as why:
                self.respond(400, {"error": {"type": "InvalidInput", "message": f"the request is not valid: {why}"}})
                return
            try:
                self.respond(200, model.answer(self.path, request))
            except Invalid as why:
                self.respond(why.status, {"error": {"type": why.kind, "message": str(why)}})

        def log_message(self, *_: Any) -> None:
            """Prints nothing, because the response already reports an error to the client."""

    return ThreadingHTTPServer((host, port), Handler)


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m beamwork.umbridge", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", help="a scene file, or the name of a built-in case")
    parser.add_argument("-f", "--formulation", help="formulation; default: one that supports the physics of the scene")
    parser.add_argument("-n", "--elements", type=int, help="number of elements per member; default: enough for an error of 0.001")
    parser.add_argument("--inputs", metavar="NAME,...", help="input parameters; default: all parameters that are numbers")
    parser.add_argument("--outputs", metavar="NAME,...", help="output quantities; default: all quantities that are not curves")
    parser.add_argument("--port", type=int, default=4242)
    parser.add_argument("--host", default="localhost", help="address on which to listen; 0.0.0.0: all addresses (default: %(default)s)")
    given = parser.parse_args()
    try:
        scene = Scene.open(given.scene) if os.path.exists(given.scene) else Scene.case(given.scene)
        model = Model(scene, given.inputs and given.inputs.split(","), given.outputs and given.outputs.split(","),
                      given.formulation, given.elements)
        served = server(model, given.port, given.host)
    except (Error, ValueError) as why:
        print(f"beamwork.umbridge: {why}", file=sys.stderr)
        return 2
    except OSError as why:
        print(f"beamwork.umbridge: port {given.port}: {why.strerror}; choose another --port", file=sys.stderr)
        return 4
    print(f"http://{given.host}:{served.server_port} {MODEL}: {', '.join(model.inputs)} -> {', '.join(model.outputs)}",
          flush=True)
    try:
        served.serve_forever()
    except KeyboardInterrupt:
        pass
    return 0


if __name__ == "__main__":
    sys.exit(main())
