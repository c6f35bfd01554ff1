//! Writes `$OUT_DIR/scara.rs`.

fn main() -> Result<(), kin_codegen::build::Error> {
    kin_codegen::build::Config::new("../../robots/scara.yaml")
        .name("Arm")
        .generate()?;
    Ok(())
}
