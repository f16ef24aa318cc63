"""A scenario of 0.1 s as text, like that of campaign_folder.h."""


def tiny_scenario(source, name, checks="[{check: no_collision}]"):
    """Returns the scenario. `source` is the folder of the project, `name` the text of a quoted YAML string, `checks` a YAML list."""
    return f"""use: {source}/configs/garratt2009_room_0_light.yaml
name: "{name}"
duration: 0.1
scene: {{texture_size: 64}}
velocimeter: {{enabled: false}}
drawing: {{renderer: tiles}}
rig: {{cameras: [{{role: front, width: 16, height: 16, fov: 90, rate: 25, channel: grey}}]}}
avoidance: {{module: go_to_goal}}
goal: {{north: 5, east: 0, altitude: 1, radius: 1}}
checks: {checks}
"""
