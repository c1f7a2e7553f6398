use std::collections::HashSet;

use opcua_configurator::model::activation::{self, ActivationEntry};
use opcua_configurator::model::text::decode;
use opcua_configurator::model::{ControllerSeries, SerialNumber};
use opcua_configurator::workspace::{Configuration, ConnectionList, NewConnection, SkippedLine};

/// [`activation::parse`]: every serial number once, every line number that of its line, no key in a mistake; and what
/// was understood is understood again from its own words.
pub fn activation_file(bytes: &[u8]) {
    let Ok(file) = activation::parse(bytes) else { return };
    let lines = lines(bytes);

    // There may be quotation marks around it and in it.
    let stands_in = |serial: &SerialNumber, line: usize| lines[line - 1].replace('"', "").contains(serial.as_str());
    let mut serials = HashSet::new();
    let mut canonical = format!("{}\n", activation::FIRST_LINE);
    for line in file.lines() {
        assert!(serials.insert(line.serial.as_str().to_ascii_uppercase()), "{} twice", line.serial);
        assert!(stands_in(&line.serial, line.line), "line {}", line.line);
        assert_eq!(file.find(&line.serial), ActivationEntry::Line(line));
        canonical += &format!("{},{},{}\n", line.serial, line.keys.licence, line.keys.activation);
    }
    for mistake in file.mistakes() {
        assert!(!lines[mistake.line - 1].trim().is_empty(), "line {}", mistake.line);
        if let Some(serial) = &mistake.serial {
            assert!(stands_in(serial, mistake.line), "line {}", mistake.line);
        }
        assert!(mistake.to_string().chars().count() < 200, "it says what is wrong, not what was bought");
    }
    let numbers: Vec<usize> = file.lines().iter().map(|line| line.line).collect();
    assert!(numbers.is_sorted() && file.mistakes().is_sorted_by_key(|mistake| mistake.line));

    let again = activation::parse(canonical.as_bytes()).expect("canonical");
    assert!(again.mistakes().is_empty());
    assert!(
        again
            .lines()
            .iter()
            .map(|line| (&line.serial, &line.keys))
            .eq(file.lines().iter().map(|line| (&line.serial, &line.keys)))
    );
}

/// The lines of a text.
fn lines(bytes: &[u8]) -> Vec<String> {
    let text = decode(bytes).expect("what was taken is text").replace("\r\n", "\n");
    text.split(['\r', '\n']).map(str::to_owned).collect()
}

/// [`ConnectionList`]: what is added is new and unique, and the list read once more adds nothing.
pub fn connection_list(bytes: &[u8]) {
    let mut configuration = Configuration::default();
    let known = NewConnection { name: "Cell 2".parse().expect("name"), address: "10.0.0.1".parse().expect("address") };
    configuration.controllers.push(known.entry(ControllerSeries::Rc700));
    let Ok(list) = ConnectionList::parse(bytes) else { return };
    let lines = lines(bytes).len();
    let plan = list.plan(&configuration);
    assert!(plan.is_sorted_by_key(|planned| planned.line));
    for planned in plan {
        assert!(planned.line > 0 && planned.line <= lines, "line {} of {lines}", planned.line);
        match planned.verdict {
            Ok(new) => {
                configuration.check_new(&new.name, &new.address).expect("neither name nor address is taken");
                configuration.controllers.push(new.entry(ControllerSeries::Rc700));
            }
            Err(skipped) => drop(skipped.problem(planned.line)),
        }
    }
    let added = |verdict: &Result<NewConnection, SkippedLine>| verdict.is_ok();
    assert!(!list.plan(&configuration).iter().any(|planned| added(&planned.verdict)));
}
