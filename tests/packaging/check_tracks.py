#!/usr/bin/env python3
"""Checks a trajectory.gpx and a trajectory.kml against the rules of their schemas (GPX 1.1's gpx.xsd,
OGC KML 2.2's ogckml22.xsd), as far as a run writes their elements: which children an element has, in
which order and how often, which attributes, and what their values may be.

    check_tracks.py GPX KML     prints the number of points of each; exit code 1 with the first fault
"""

import datetime
import re
import sys
import xml.etree.ElementTree as ET

GPX = "{http://www.topografix.com/GPX/1/1}"
KML = "{http://www.opengis.net/kml/2.2}"


class Fault(Exception):
    """What breaks a rule."""


def number(low, high):
    """xsd:decimal or xsd:double within bounds."""

    def check(text):
        if not re.fullmatch(r"-?\d+(\.\d+)?", text) or not low <= float(text) <= high:
            raise Fault(f"'{text}' is no number from {low} to {high}")

    return check


def date_time(text):
    """xsd:dateTime in UTC."""
    if not re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d(\.\d+)?Z", text):
        raise Fault(f"'{text}' is no xsd:dateTime in UTC")
    datetime.datetime.fromisoformat(text[:19])


def one_of(*values):
    def check(text):
        if text not in values:
            raise Fault(f"'{text}' is none of {values}")

    return check


def hex_colour(text):
    if not re.fullmatch(r"[0-9a-f]{8}", text):
        raise Fault(f"'{text}' is no colour aabbggrr")


def coordinates(text):
    """Tuples lon,lat[,alt] between blanks."""
    for place in text.split():
        parts = place.split(",")
        if len(parts) not in (2, 3):
            raise Fault(f"'{place}' is no lon,lat,alt")
        for part, bound in zip(parts, (180, 90, 1e5)):
            number(-bound, bound)(part)


def any_text(_text):
    pass


def reference(text):
    if not text.startswith("#"):
        raise Fault(f"'{text}' leads nowhere")


# Element: (children in the schema's order with the most of each (0: any number), attributes that it
# must have, the check of its text). Children that are not listed are none of the schema's.
GPX_RULES = {
    "gpx": ([("metadata", 1), ("wpt", 0), ("rte", 0), ("trk", 0), ("extensions", 1)],
            {"version": one_of("1.1"), "creator": any_text}, None),
    "trk": ([("name", 1), ("cmt", 1), ("desc", 1), ("src", 1), ("link", 0), ("number", 1),
             ("type", 1), ("extensions", 1), ("trkseg", 0)], {}, None),
    "trkseg": ([("trkpt", 0), ("extensions", 1)], {}, None),
    "trkpt": ([("ele", 1), ("time", 1), ("magvar", 1), ("geoidheight", 1), ("name", 1)],
              {"lat": number(-90, 90), "lon": number(-180, 179.999999999)}, None),
    "ele": ([], {}, number(-1e5, 1e5)),
    "time": ([], {}, date_time),
    "name": ([], {}, any_text),
    "desc": ([], {}, any_text),
}
KML_RULES = {
    "kml": ([("Document", 1)], {}, None),
    "Document": ([("name", 1), ("visibility", 1), ("open", 1), ("description", 1), ("styleUrl", 1),
                  ("Style", 0), ("Schema", 0), ("Placemark", 0)], {}, None),
    "Style": ([("IconStyle", 1), ("LabelStyle", 1), ("LineStyle", 1), ("PolyStyle", 1)],
              {"id": any_text}, None),
    "LineStyle": ([("color", 1), ("colorMode", 1), ("width", 1)], {}, None),
    "Placemark": ([("name", 1), ("visibility", 1), ("open", 1), ("description", 1),
                   ("styleUrl", 1), ("LineString", 1)], {}, None),
    "LineString": ([("extrude", 1), ("tessellate", 1), ("altitudeMode", 1), ("coordinates", 1)], {},
                   None),
    "color": ([], {}, hex_colour),
    "width": ([], {}, number(0, 100)),
    "name": ([], {}, any_text),
    "description": ([], {}, any_text),
    "styleUrl": ([], {}, reference),
    "tessellate": ([], {}, one_of("0", "1")),
    "altitudeMode": ([], {}, one_of("clampToGround", "relativeToGround", "absolute")),
    "coordinates": ([], {}, coordinates),
}


def check_children(element, allowed, space):
    place, count = 0, 0
    for child in element:
        name = child.tag[len(space):]
        if not child.tag.startswith(space) or name not in [known for known, _ in allowed]:
            raise Fault(f"{element.tag} has a child {child.tag}")
        at = [known for known, _ in allowed].index(name)
        if at < place:
            raise Fault(f"{name} comes too late in {element.tag}")
        count = count + 1 if at == place else 1
        place = at
        if allowed[at][1] and count > allowed[at][1]:
            raise Fault(f"{element.tag} has more than one {name}")


def check(element, rules, space):
    children, attributes, text = rules[element.tag[len(space):]]
    check_children(element, children, space)
    if set(element.attrib) != set(attributes):
        raise Fault(f"{element.tag} has the attributes {sorted(element.attrib)}")
    for name, rule in attributes.items():
        rule(element.get(name))
    if text is None and (element.text or "").strip():
        raise Fault(f"{element.tag} holds text")
    if text is not None:
        text(element.text or "")
    for child in element:
        check(child, rules, space)


def check_file(path, root, rules, space):
    element = ET.parse(path).getroot()
    if element.tag != space + root:
        raise Fault(f"{path} begins with {element.tag}")
    check(element, rules, space)
    return element


def main(gpx_path, kml_path):
    gpx = check_file(gpx_path, "gpx", GPX_RULES, GPX)
    times = [time.text for time in gpx.iter(GPX + "time")]
    if times != sorted(times):
        raise Fault("the points of the track are not in order of time")
    kml = check_file(kml_path, "kml", KML_RULES, KML)
    styles = {style.get("id") for style in kml.iter(KML + "Style")}
    for url in kml.iter(KML + "styleUrl"):
        if url.text[1:] not in styles:
            raise Fault(f"there is no style {url.text}")
    line = next(kml.iter(KML + "coordinates")).text.split()
    print(len(list(gpx.iter(GPX + "trkpt"))), len(line))


if __name__ == "__main__":
    try:
        main(*sys.argv[1:3])
    except (Fault, ET.ParseError, StopIteration) as fault:
        sys.exit(f"{sys.argv[1:3]}: {fault}")
