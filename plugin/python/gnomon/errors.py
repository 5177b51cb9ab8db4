"""VTK's errors, for exceptions."""


def collect_errors(caller):
    """Return a list that gets the text of each error of a VTK object, and the observer's number."""
    errors = []

    def take(_caller, _event, message):
        errors.append(message.split("): ", 1)[-1].strip())

    take.CallDataType = "string0"
    return errors, caller.AddObserver("ErrorEvent", take)
