"""compare.py OLD NEW DOC...: mutates each document and reports where one schema accepts and the other refuses."""
import copy, json, random, sys
import jsonschema
old, new = (json.load(open(f)) for f in sys.argv[1:3])
A, B = (jsonschema.Draft7Validator(s) for s in (old, new))
random.seed(5)
def places(value, at=()):
    if at: yield at
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for n, (key, child) in enumerate(items):
        if isinstance(value, list) and n > 1: break
        yield from places(child, at + (key,))
def put(doc, at, value, drop=False):
    doc = copy.deepcopy(doc)
    target = doc
    for key in at[:-1]: target = target[key]
    if drop: del target[at[-1]]
    else: target[at[-1]] = value
    return doc
count = differ = 0
seen = {}
for file in sys.argv[3:]:
    doc = json.load(open(file))
    for at in places(doc):
        tries = [(repr(v), put(doc, at, v)) for v in ("a word", "", -1e9, 1e9, -1, 0, 0.5, 1, 2.5, 1e6, {}, [], [1], [1, 2], [0.5, 2], [1, 2, 3], [[1, 2]], True, None, [[0,0],[1,0],[1,1]])]
        tries.append(("dropped", put(doc, at, None, True)))
        value = doc
        for key in at: value = value[key]
        if isinstance(value, dict): tries.append(("more", put(doc, at + ("sky_colour",), 1)))
        for what, changed in tries:
            count += 1
            a, b = A.is_valid(changed), B.is_valid(changed)
            if a != b:
                differ += 1
                key = (tuple(k for k in at if not isinstance(k, int)), what, a, b)
                seen.setdefault(key, file)
print(count, "documents,", differ, "differ")
for key, file in list(seen.items())[:40]: print(key, file)
