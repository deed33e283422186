//! Stores with damaged bytes: every command that reads one must report the damage or give correct results, and `vibro
//! resume` must repair it to the same bytes.

mod damage;

use crate::case::Property;
use crate::limits::{Limits, ProcessEnd, run};
use crate::rules;
use damage::{Damage, Files, damage, files, write};
use proptest::prelude::*;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tempfile::TempDir;
use vibroimpact_store::{Folder, Part, Store};
use vibroimpact_study::{Control, Plan};

/// Plans of a few tiles each, one of every kind of study.
const PLANS: [&str; 6] = [
    r#"{"version":1,"tile":3,"system":{"inverse_beta":1.3,"gap":0.75,"restitution":0.5},"task":{"basin":{"axes":[{"vary":"x","over":"-4:0.75:7"},{"vary":"v","over":"-4:4:5"}]}}}"#,
    r#"{"version":1,"tile":4,"system":{"restitution":0.5},"task":{"map":{"axes":[{"vary":"inverse_beta","over":"0.6:1.4:9"},{"vary":"gap","over":"-0.5:2:5"}],"starts":2}}}"#,
    r#"{"version":1,"tile":4,"system":{"restitution":0.5},"task":{"map":{"axes":[{"vary":"inverse_beta","over":"0.6:1.4:9"},{"vary":"gap","over":"0:2:9"}],"starts":1,"refine":4}}}"#,
    r#"{"version":1,"tile":2,"system":{"inverse_beta":1.3,"restitution":0.5},"task":{"diagram":{"vary":"gap","over":"0:2:6","transient":50,"keep":4}}}"#,
    r#"{"version":1,"tile":8,"system":{"inverse_beta":1.3,"gap":0.75,"restitution":0.5},"task":{"attractors":{"starts":30,"seed":1}}}"#,
    r#"{"version":1,"tile":1,"system":{"inverse_beta":1.11,"restitution":0.5},"task":{"lyapunov":{"axes":[{"vary":"gap","over":"2:3:3"}],"impacts":1000,"transient":100}}}"#,
];

/// A store and its damage.
#[derive(Clone, Debug)]
pub struct Damaged {
    plan: usize,
    damage: Vec<Damage>,
}

/// The family of damaged stores.
#[derive(Debug)]
pub struct Stores {
    vibro: PathBuf,
    scratch: TempDir,
    whole: Vec<Option<(Files, Vec<u8>)>>,
}

impl Stores {
    /// Tests this command.
    pub(crate) fn new(vibro: &Path) -> io::Result<Self> {
        Ok(Self { vibro: vibro.canonicalize()?, scratch: TempDir::new()?, whole: vec![None; PLANS.len()] })
    }

    fn vibro(&self, folder: &Path, line: &str) -> Result<ProcessEnd, String> {
        let words: Vec<String> = line.split(' ').map(str::to_owned).collect();
        let ran = run(&self.vibro, &words, (folder, self.scratch.path()), &Limits::default())
            .map_err(|why| why.to_string())?;
        let told = |why| format!("vibro {line}: {why}");
        let code = ran.ended_with(&[0, 1, 2]).map_err(told)?;
        if code != 0 || !ran.stderr.is_empty() {
            rules::sentence(&ran.stderr).map_err(told)?;
        }
        Ok(ran)
    }

    /// The undamaged store of a plan, and its table.
    fn whole(&mut self, k: usize) -> Result<(Files, Vec<u8>), String> {
        if let Some(whole) = &self.whole[k] {
            return Ok(whole.clone());
        }
        let folder = TempDir::new_in(self.scratch.path()).map_err(|why| why.to_string())?;
        let place = folder.path().join("s.zarr");
        let plan = Plan::from_text(PLANS[k]).map_err(|why| why.to_string())?;
        let store = Store::create(Arc::new(Folder::new(&place)), &plan).map_err(|why| why.to_string())?;
        store.run(Part::ALL, &Control { threads: 1, ..Control::default() }).map_err(|why| why.to_string())?;
        let table = self.vibro(folder.path(), "export s.zarr --csv -")?.stdout;
        let whole = (files(&place).map_err(|why| why.to_string())?, table);
        self.whole[k] = Some(whole.clone());
        Ok(whole)
    }
}

impl Property for Stores {
    type Case = Damaged;

    fn strategy(&self) -> BoxedStrategy<Damaged> {
        (0..PLANS.len(), prop::collection::vec(Damage::strategy(), 1..3))
            .prop_map(|(plan, damage)| Damaged { plan, damage })
            .boxed()
    }

    fn describe(&self, case: &Damaged) -> String {
        let files = self.whole[case.plan].as_ref().map(|(files, _)| files);
        let told = |damage: &Damage| files.map_or_else(|| format!("{damage:?}"), |files| damage.told(files));
        let damage: Vec<String> = case.damage.iter().map(told).collect();
        format!("the store of {}\nwith {}", PLANS[case.plan], damage.join(", "))
    }

    fn check(&mut self, case: &Damaged) -> Result<(), String> {
        let (want, table) = self.whole(case.plan)?;
        let folder = TempDir::new_in(self.scratch.path()).map_err(|why| why.to_string())?;
        let place = folder.path().join("s.zarr");
        write(&want, &place)
            .and_then(|()| damage(&want, &place, &case.damage))
            .map_err(|why| format!("the damage fails: {why}"))?;
        let now = files(&place).map_err(|why| why.to_string())?;
        let exchanged = case.damage.iter().any(|damage| matches!(damage, Damage::Swap(..)));
        let folder = folder.path();

        self.vibro(folder, "status s.zarr --json")?;
        self.vibro(folder, "status s.zarr")?;
        let verified = self.vibro(folder, "verify s.zarr --sample 1000 --json --quiet")?;
        if verified.code == Some(0) {
            let object = rules::object(&verified.stdout)?;
            if now != want && object["open"] == 0 {
                return Err("`vibro verify` finds nothing wrong".to_owned());
            }
        }
        let exported = self.vibro(folder, "export s.zarr --csv - --quiet")?;
        // a tile without a status counts as never computed, and has empty cells
        let open = now.keys().filter(|key| key.starts_with("status/")).count()
            < want.keys().filter(|key| key.starts_with("status/")).count();
        if exported.code == Some(0) && exported.stdout != table && !exchanged && !open {
            return Err("`vibro export` writes another table, and no complaint".to_owned());
        }
        self.vibro(folder, "plot s.zarr out.svg --quiet")?;
        let resumed = self.vibro(folder, "resume s.zarr --json --quiet")?;
        let after = files(&place).map_err(|why| why.to_string())?;
        if resumed.code == Some(0) && after != want && !exchanged {
            let other: Vec<&String> =
                want.keys().chain(after.keys()).filter(|key| want.get(*key) != after.get(*key)).collect();
            return Err(format!("`vibro resume` leaves {other:?} other than they were"));
        }
        Ok(())
    }
}
